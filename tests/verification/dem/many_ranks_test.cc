// A scene on many ranks against the same scene on one: the same bits of every
// particle, contact, force and energy. The program runs on 1, 2 and 3 ranks,
// and on 4 and 8 under the label long.
#include "dem_scene.h"

#include <dem/parallel/distribution.h>
#include <dem/parallel/mpi_ranks.h>
#include <dem/random.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <tuple>

namespace
{
struct Scene
{
  dem::EngineParameters parameters;
  bool has_shapes = false;
  int n_along = 6;          ///< particles along an edge of the box
  double jitter_speed = 1.; ///< of the particles at first [m/s]
  int n_steps = 1500;
  double time_step = 2e-6; ///< [s]
};

dem::EngineParameters parameters()
{
  dem::EngineParameters p;
  p.gravity = {0., 0., -9.81};
  p.breakage.is_active = false;
  return p;
}

double between(dem::Random &random, double low, double high)
{
  return low + (high - low) * random.uniform();
}

/// Five bumpy bodies.
std::vector<std::shared_ptr<const dem::Coefficients>> series()
{
  std::vector<std::shared_ptr<const dem::Coefficients>> all;
  dem::Random random(11);
  for (int s = 0; s < 5; ++s)
  {
    dem::Coefficients bumpy(std::size_t(dem::n_coefficients(8)), 0.);
    bumpy[0] = 1. / dem::equivalent_radius_factor;
    for (std::size_t k = 4; k < bumpy.size(); ++k)
      bumpy[k] = between(random, -0.03, 0.03);
    all.push_back(std::make_shared<const dem::Coefficients>(std::move(bumpy)));
  }
  return all;
}

/// Graded particles on a lattice in a box that its lid closes slowly.
dem::Engine build(const Scene &scene, std::shared_ptr<dem::Ranks> ranks)
{
  dem::Engine engine(scene.parameters, std::move(ranks));
  const double spacing = 0.012;
  const double edge = scene.n_along * spacing;
  dem::Random random(3);
  const auto shapes = series();
  std::vector<dem::Vec3> velocity;
  for (int i = 0; i < scene.n_along * scene.n_along * scene.n_along; ++i)
  {
    const dem::Vec3 cell(i % scene.n_along, i / scene.n_along % scene.n_along,
                         i / scene.n_along / scene.n_along);
    const double radius = between(random, 0.003, 0.0058);
    const auto body = scene.has_shapes
                          ? dem::make_shape(shapes[std::size_t(i % 5)], radius)
                          : dem::make_sphere(radius);
    const dem::Quaternion turned(
        dem::Quaternion(between(random, 0.1, 1.), between(random, -1., 1.),
                        between(random, -1., 1.), between(random, -1., 1.))
            .normalized());
    engine.add_particle(body, spacing * (cell + dem::Vec3::Constant(0.5)),
                        turned);
    velocity.emplace_back(between(random, -1., 1.), between(random, -1., 1.),
                          between(random, -1., 0.));
  }
  dem::ParticleSystem &particles = engine.particles();
  for (std::size_t k = 0; k < particles.size(); ++k)
    particles.velocity(k) =
        scene.jitter_speed * velocity[std::size_t(particles.id[k])];
  for (int d = 0; d < 3; ++d)
    for (const double side : {1., -1.})
    {
      const dem::Vec3 normal = side * dem::Vec3::Unit(d);
      add_plane(engine,
                side > 0. ? dem::Vec3::Zero()
                          : dem::Vec3(dem::Vec3::Constant(edge)),
                normal);
    }
  planes(engine).back().velocity = {0., 0., -0.5};
  return engine;
}

/// What a particle is, in numbers.
std::vector<double> numbers(const dem::ParticleSystem &particles, std::size_t k)
{
  const dem::Vec3 &x = particles.position(k), &v = particles.velocity(k),
                  &w = particles.spin(k);
  const auto &q = particles.orientation(k).coeffs();
  return {x.x(),
          x.y(),
          x.z(),
          v.x(),
          v.y(),
          v.z(),
          w.x(),
          w.y(),
          w.z(),
          q[0],
          q[1],
          q[2],
          q[3],
          particles.path_length[k],
          particles.mass(k)};
}

/// Ids of both particles, and the number of the contact among those of the
/// pair.
using ContactKey = std::tuple<std::int64_t, std::int64_t, int>;

/// Springs of the touching contacts of owned particles.
std::map<ContactKey, std::vector<double>> contacts(const dem::Engine &engine)
{
  std::map<ContactKey, std::vector<double>> all;
  const dem::ContactBatch &pairs = engine.pairs();
  const dem::ParticleSystem &particles = engine.particles();
  for (const std::int32_t row : pairs.by_pair())
  {
    const auto k = std::size_t(row);
    if (!pairs.is_touching(k))
      continue;
    ContactKey key{particles.id[std::size_t(pairs.a[k])],
                   particles.id[std::size_t(pairs.b[k])], 0};
    while (all.contains(key))
      ++std::get<2>(key);
    const auto shear = pairs.shear[k];
    all[key] = {shear.x, shear.y, shear.z, pairs.overlap[k],
                pairs.normal_force[k]};
  }
  return all;
}

/// The same scene on all ranks together and on this one alone.
struct Twins
{
  explicit Twins(const Scene &scene)
      : all(dem::mpi_ranks()), shared(build(scene, all)),
        alone(build(scene, dem::one_rank()))
  {
  }

  void advance(const Scene &scene, int n_steps)
  {
    for (int step = 0; step < n_steps; ++step)
    {
      shared.advance(scene.time_step);
      alone.advance(scene.time_step);
      std::array listed{std::int64_t(shared.pairs().size())};
      all->sum(listed);
      ASSERT_EQ(listed[0], std::int64_t(alone.pairs().size()));
      ASSERT_EQ(shared.n_rebuilds(), alone.n_rebuilds());
    }
  }

  void expect_same_bits()
  {
    const dem::ParticleSystem &mine = shared.particles(),
                              &expected = alone.particles();
    std::map<std::int64_t, std::size_t> row;
    for (std::size_t k = 0; k < expected.size(); ++k)
      row[expected.id[k]] = k;
    for (std::size_t k = 0; k < mine.n_owned(); ++k)
      ASSERT_EQ(numbers(mine, k), numbers(expected, row[mine.id[k]]))
          << "particle " << mine.id[k];
    const auto there = contacts(alone);
    for (const auto &[key, springs] : contacts(shared))
    {
      const auto found = there.find(key);
      ASSERT_NE(found, there.end())
          << std::get<0>(key) << " " << std::get<1>(key);
      ASSERT_EQ(springs, found->second)
          << std::get<0>(key) << " " << std::get<1>(key);
    }
    std::array<std::int64_t, 2> counts{std::int64_t(mine.n_owned()),
                                       std::int64_t(contacts(shared).size())};
    all->sum(counts);
    EXPECT_EQ(counts[0], std::int64_t(expected.size()));
    EXPECT_EQ(counts[1], std::int64_t(there.size()));
    expect_same_sums();
  }

  void expect_same_sums()
  {
    for (std::size_t p = 0; p < planes(alone).size(); ++p)
    {
      EXPECT_EQ(planes(shared)[p].force, planes(alone)[p].force);
      EXPECT_EQ(planes(shared)[p].work, planes(alone)[p].work);
    }
    const dem::EngineEnergy one = shared.energy(), other = alone.energy();
    EXPECT_EQ(one.kinetic, other.kinetic);
    EXPECT_EQ(one.elastic, other.elastic);
    EXPECT_EQ(one.friction, other.friction);
    EXPECT_EQ(one.rolling, other.rolling);
    EXPECT_EQ(one.damping, other.damping);
    EXPECT_EQ(one.non_conservative_work, other.non_conservative_work);
    EXPECT_EQ(one.gravity_work, other.gravity_work);
    EXPECT_GT(one.friction, 0.);
    EXPECT_EQ(shared.n_rebuilds(), alone.n_rebuilds());
  }

  std::shared_ptr<dem::Ranks> all;
  dem::Engine shared, alone;
};

void expect_same_bits(const Scene &scene, std::int64_t partition_interval)
{
  Twins twins(scene);
  twins.shared.set_partition_interval(partition_interval);
  for (int part = 0; part < 5; ++part)
  {
    twins.advance(scene, scene.n_steps / 5);
    twins.expect_same_bits();
  }
  if (twins.all->size() == 1)
    return;
  EXPECT_GT(twins.shared.distribution().n_partitions(), 0);
  std::array largest{double(twins.shared.distribution().exchange().n_ghosts())};
  twins.all->max(largest);
  EXPECT_GT(largest[0], 0.);
}

TEST(ManyRanks, SpheresInAClosingBox)
{
  Scene scene;
  scene.parameters = parameters();
  scene.parameters.geometry.geometry = dem::ContactGeometry::sphere;
  expect_same_bits(scene, 0);
}

TEST(ManyRanks, BoxesAreMadeAgainAtEveryMigration)
{
  Scene scene;
  scene.parameters = parameters();
  scene.parameters.geometry.geometry = dem::ContactGeometry::sphere;
  scene.jitter_speed = 3.;
  expect_same_bits(scene, 1);
}

TEST(ManyRanks, LocalDampingAndDmtAttraction)
{
  Scene scene;
  scene.parameters = parameters();
  scene.parameters.geometry.geometry = dem::ContactGeometry::sphere;
  scene.parameters.local_damping = 0.3;
  scene.parameters.particle.law = "dmt";
  scene.parameters.particle.law_values = {0.1, 1e-5};
  expect_same_bits(scene, 2);
}

TEST(ManyRanks, RadiiAlongTheBranch)
{
  Scene scene;
  scene.parameters = parameters();
  scene.has_shapes = true;
  scene.n_along = 5;
  expect_same_bits(scene, 1);
}

TEST(ManyRanks, RadiiTowardsTheWallsToo)
{
  Scene scene;
  scene.parameters = parameters();
  scene.parameters.geometry.wall_geometry = dem::ContactGeometry::radial;
  scene.parameters.wall.law = "hertz";
  scene.has_shapes = true;
  scene.n_along = 5;
  expect_same_bits(scene, 2);
}

TEST(ManyRanks, TrueSurfaces)
{
  Scene scene;
  scene.parameters = parameters();
  scene.parameters.geometry.geometry = dem::ContactGeometry::surface;
  scene.parameters.geometry.wall_geometry = dem::ContactGeometry::surface;
  scene.has_shapes = true;
  scene.n_along = 4;
  expect_same_bits(scene, 1);
}

/// Particles that spall at contacts with others and with walls.
void expect_same_events(Scene scene)
{
  scene.parameters.breakage.is_active = true;
  scene.parameters.breakage.fracture_energy = 2.;
  scene.parameters.breakage.min_diameter = 0.;
  scene.has_shapes = true;
  scene.n_along = 4;
  scene.n_steps = 900;
  Twins twins(scene);
  twins.shared.set_partition_interval(1);
  for (int part = 0; part < 5; ++part)
  {
    twins.advance(scene, scene.n_steps / 5);
    twins.expect_same_bits();
  }
  const auto events = twins.shared.take_events(),
             expected = twins.alone.take_events();
  EXPECT_GT(expected.size(), 20u);
  ASSERT_EQ(events.size(), expected.size());
  for (std::size_t e = 0; e < events.size(); ++e)
  {
    EXPECT_EQ(events[e].particle, expected[e].particle);
    EXPECT_EQ(events[e].other, expected[e].other);
    EXPECT_EQ(events[e].time, expected[e].time);
    EXPECT_EQ(events[e].force_after, expected[e].force_after);
    EXPECT_EQ(events[e].released_energy, expected[e].released_energy);
    EXPECT_EQ(events[e].removed_volume, expected[e].removed_volume);
  }
  const dem::EngineEnergy one = twins.shared.energy(),
                          other = twins.alone.energy();
  EXPECT_EQ(one.breakage, other.breakage);
  EXPECT_EQ(one.fracture, other.fracture);
}

TEST(ManyRanks, CornersBreakOff)
{
  Scene scene;
  scene.parameters = parameters();
  scene.parameters.geometry.wall_geometry = dem::ContactGeometry::radial;
  expect_same_events(scene);
}

TEST(ManyRanks, CornersOfTrueSurfacesBreakOff)
{
  Scene scene;
  scene.parameters = parameters();
  scene.parameters.geometry.geometry = dem::ContactGeometry::surface;
  scene.parameters.geometry.wall_geometry = dem::ContactGeometry::surface;
  expect_same_events(scene);
}

/// Fewer particles than ranks, and ranks whose boxes are empty.
TEST(ManyRanks, OneParticle)
{
  Scene scene;
  scene.parameters = parameters();
  scene.parameters.geometry.geometry = dem::ContactGeometry::sphere;
  scene.n_along = 1;
  Twins twins(scene);
  twins.advance(scene, 500);
  const dem::ParticleSystem &mine = twins.shared.particles();
  for (std::size_t k = 0; k < mine.n_owned(); ++k)
    EXPECT_EQ(numbers(mine, k), numbers(twins.alone.particles(), 0));
}

/// A fault that one rank sees ends all of them with its message.
TEST(ManyRanks, AFaultOfOneRankIsOneOfAll)
{
  Scene scene;
  scene.parameters = parameters();
  scene.parameters.geometry.geometry = dem::ContactGeometry::sphere;
  Twins twins(scene);
  twins.advance(scene, 10);
  for (dem::Engine *engine : {&twins.shared, &twins.alone})
  {
    dem::ParticleSystem &particles = engine->particles();
    for (std::size_t k = 0; k < particles.n_owned(); ++k)
      if (particles.id[k] == 7)
        particles.velocity(k).x() = std::nan("");
  }
  const auto message = [&scene](dem::Engine &engine)
  {
    try
    {
      engine.advance(scene.time_step);
    }
    catch (const std::runtime_error &error)
    {
      return std::string(error.what());
    }
    return std::string();
  };
  const std::string one = message(twins.shared);
  EXPECT_NE(one, "");
  EXPECT_EQ(one, message(twins.alone));
}

TEST(ManyRanks, TooDeepAnOverlapStopsAll)
{
  Scene scene;
  scene.parameters = parameters();
  scene.parameters.geometry.geometry = dem::ContactGeometry::sphere;
  scene.parameters.geometry.overlap.stop = 1e-3;
  Twins twins(scene);
  const auto steps = [&scene](dem::Engine &engine)
  {
    for (int step = 0; step < scene.n_steps; ++step)
      try
      {
        engine.advance(scene.time_step);
      }
      catch (const dem::OverlapStop &)
      {
        return step;
      }
    return -1;
  };
  const int stopped = steps(twins.shared);
  EXPECT_GE(stopped, 0);
  EXPECT_EQ(stopped, steps(twins.alone));
}

TEST(ManyRanks, WhatCannotBeSharedIsRefused)
{
  Scene scene;
  scene.parameters = parameters();
  scene.parameters.breakage.is_active = true;
  scene.parameters.breakage.memory = dem::FactorMemory::patch;
  dem::Engine engine = build(scene, dem::mpi_ranks());
  if (dem::mpi_ranks()->size() == 1)
    EXPECT_NO_THROW(engine.advance(scene.time_step));
  else
    EXPECT_THROW(engine.advance(scene.time_step), std::invalid_argument);
}
} // namespace
