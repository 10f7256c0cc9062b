#pragma once

#include "dem_scene.h"

#include <dem/measure/assembly.h>
#include <dem/measure/boundary_load.h>
#include <dem/measure/contact_springs.h>
#include <dem/measure/roundness_book.h>
#include <dem/measure/totals.h>
#include <dem/parallel/distribution.h>
#include <dem/parallel/first_rank.h>
#include <dem/parallel/mpi_ranks.h>
#include <dem/parallel/shared_input.h>
#include <dem/random.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <sstream>
#include <tuple>

/// A scene on many ranks beside the same scene on one.
namespace many_ranks
{
struct Scene
{
  dem::EngineParameters parameters;
  bool has_shapes = false;
  int n_along = 6;          ///< particles along an edge of the box
  double jitter_speed = 1.; ///< of the particles at first [m/s]
  int n_steps = 1500;
  double time_step = 2e-6; ///< [s]
  bool has_drum = false;   ///< instead of the box: it turns, with a lifter
  bool has_sheet = false;  ///< instead of the lid: a sheet with ripples
};

inline dem::EngineParameters parameters()
{
  dem::EngineParameters p;
  p.gravity = {0., 0., -9.81};
  p.breakage.is_active = false;
  return p;
}

inline double between(dem::Random &random, double low, double high)
{
  return low + (high - low) * random.uniform();
}

/// Five bumpy bodies.
inline std::vector<std::shared_ptr<const dem::Coefficients>> series()
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

/// A sheet over the box, seen from above counter-clockwise.
inline dem::FacetSurface sheet(double edge)
{
  constexpr int n = 9;
  dem::FacetSurface surface;
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i)
      surface.position.emplace_back(edge * (1.2 * i / n - 0.1),
                                    edge * (1.2 * j / n - 0.1), edge);
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i)
    {
      const int at = j * (n + 1) + i;
      surface.triangles.push_back({at, at + 1, at + n + 2});
      surface.triangles.push_back({at, at + n + 2, at + n + 1});
    }
  surface.velocity.assign(surface.position.size(), dem::Vec3::Zero());
  surface.mass.assign(surface.position.size(), 1e-4);
  surface.load = surface.velocity;
  return surface;
}

/// Graded particles on a lattice in a box that its lid closes slowly.
inline dem::Engine build(const Scene &scene, std::shared_ptr<dem::Ranks> ranks)
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
  if (scene.has_drum)
  {
    dem::Drum drum;
    drum.centre = dem::Vec3::Constant(0.5 * edge);
    drum.radius = 0.71 * edge;
    drum.length = edge;
    drum.lifter_height = 0.2 * edge;
    drum.lifter_thickness = 0.1 * edge;
    drum.spin = 30.;
    dem::set_drum(engine, drum);
    return engine;
  }
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
  if (scene.has_sheet)
  {
    deactivate_plane(engine, 5);
    attach_surface(engine, sheet(edge));
  }
  return engine;
}

/// Presses on the particles, with ripples that run along it.
inline void move_sheet(dem::Engine &engine, double time_step)
{
  dem::FacetSurface &lid = dem::surface(engine);
  const double time = engine.time() + time_step;
  for (std::size_t v = 0; v < lid.position.size(); ++v)
  {
    const dem::Vec3 &x = lid.position[v];
    lid.velocity[v] = {0.2 * std::sin(300. * x.y()), 0.,
                       -0.5 + std::sin(200. * x.x() + 2e4 * time)};
    lid.position[v] += time_step * lid.velocity[v];
  }
}

inline void advance(const Scene &scene, dem::Engine &engine)
{
  if (scene.has_sheet)
    move_sheet(engine, scene.time_step);
  engine.advance(scene.time_step);
}

/// What a particle is, in numbers.
inline std::vector<double> numbers(const dem::ParticleSystem &particles,
                                   std::size_t k)
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
inline std::map<ContactKey, std::vector<double>>
contacts(const dem::Engine &engine)
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

/// Steps that the contacts allow as they are, and before 1e-4 s have passed,
/// with the bodies that set them.
inline std::pair<std::vector<double>, std::vector<std::string>>
steps(const dem::Engine &engine)
{
  std::pair<std::vector<double>, std::vector<std::string>> all;
  for (const double horizon : {0., 1e-4})
  {
    dem::SpringNetwork network = dem::contact_springs(engine, horizon);
    dem::share_springs(engine, network);
    const dem::NetworkStep bound = dem::guaranteed_step(network);
    all.first.insert(all.first.end(),
                     {bound.step, dem::sharp_step(network),
                      static_cast<double>(dem::total_contacts(network)),
                      network.impact.duration, network.impact.speed});
    all.second.push_back(dem::describe_body(network, bound.body));
  }
  return all;
}

/// Numbers of a row of the history.
inline std::vector<double> measures(const dem::Engine &engine)
{
  const dem::ParticleSystem &own = engine.particles();
  const dem::Ranks &ranks = engine.distribution().ranks();
  const dem::ContactNetwork network = dem::contact_network(engine);
  const dem::OverlapRecord overlaps = dem::total_overlaps(engine);
  std::vector<double> all = {
      static_cast<double>(network.n_contacts),
      network.coordination_number,
      network.mean_force,
      dem::unbalanced_force_ratio(engine),
      dem::solid_volume(own, ranks),
      dem::abrasion(own, ranks),
      dem::RoundnessBook().mean(own, ranks),
      overlaps.recent,
      overlaps.largest,
      static_cast<double>(dem::total_particles(engine)),
      static_cast<double>(dem::total_contact_point_events(engine).n_scans)};
  const dem::Vec3 about(0.01, 0.02, 0.03);
  std::vector<dem::WallLoad> loads = {dem::load_on_drum(engine, about)};
  for (std::size_t p = 0; p < planes(engine).size(); ++p)
    loads.push_back(dem::load_on_plane(engine, p, about));
  for (const dem::WallLoad &load : loads)
    for (const dem::Vec3 &part : {load.force, load.moment})
      all.insert(all.end(), part.begin(), part.end());
  for (const auto &boundary : engine.boundaries())
    all.push_back(dem::total_friction(engine, *boundary));
  return all;
}

/// All that a checkpoint stores.
inline std::string stored(const dem::Engine &engine)
{
  std::ostringstream out(std::ios::binary);
  engine.save(out, {}, dem::StateExtent::scene);
  const dem::Ranks &ranks = engine.distribution().ranks();
  EXPECT_EQ(out.str().empty(), ranks.rank() != 0);
  return of_first_rank(ranks, out.str());
}

/// Where two texts differ; -1: nowhere.
inline std::int64_t first_difference(const std::string &one,
                                     const std::string &other)
{
  if (one == other)
    return -1;
  const auto [mine, yours] = std::ranges::mismatch(one, other);
  return mine - one.begin();
}

inline void restore(const std::string &from, dem::Engine &engine)
{
  const dem::Ranks &ranks = engine.distribution().ranks();
  std::istringstream source(from, std::ios::binary);
  dem::SharedInput in(ranks, ranks.rank() == 0 ? &source : nullptr);
  engine.restore(in.stream(), {});
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
      many_ranks::advance(scene, shared);
      many_ranks::advance(scene, alone);
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
    EXPECT_EQ(first_difference(stored(shared), stored(alone)), -1);
  }

  /// All ranks go on from the state of one alone, or the other way round; the
  /// other scene goes on unbroken.
  void restore_shared(const Scene &scene, std::int64_t partition_interval)
  {
    const std::string state = stored(alone);
    shared = dem::Engine(scene.parameters, all);
    shared.set_partition_interval(partition_interval);
    restore(state, shared);
  }
  void restore_alone(const Scene &scene)
  {
    const std::string state = stored(shared);
    alone = dem::Engine(scene.parameters, dem::one_rank());
    restore(state, alone);
  }

  void expect_same_sums()
  {
    const dem::Engine &some = shared, &all_here = alone;
    for (std::size_t p = 0; p < planes(all_here).size(); ++p)
    {
      EXPECT_EQ(planes(some)[p].force, planes(all_here)[p].force);
      EXPECT_EQ(planes(some)[p].work, planes(all_here)[p].work);
    }
    for (std::size_t s = 0; s < surfaces(all_here).size(); ++s)
    {
      const dem::FacetBoundary &mine = facet_boundary(some, s),
                               &yours = facet_boundary(all_here, s);
      EXPECT_EQ(mine.surface.load, yours.surface.load);
      EXPECT_EQ(mine.impulse, yours.impulse);
      EXPECT_EQ(mine.work(), yours.work());
    }
    const dem::Drum &mine = drum(some), &yours = drum(all_here);
    EXPECT_EQ(mine.torque, yours.torque);
    EXPECT_EQ(mine.thrust, yours.thrust);
    EXPECT_EQ(mine.work, yours.work);
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
    EXPECT_EQ(measures(some), measures(all_here));
    EXPECT_EQ(steps(some), steps(all_here));
  }

  std::shared_ptr<dem::Ranks> all;
  dem::Engine shared, alone;
};
} // namespace many_ranks
