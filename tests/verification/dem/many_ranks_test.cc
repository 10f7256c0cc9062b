// A scene on many ranks against the same scene on one: the same bits of every
// particle, contact, force and energy. The program runs on 1, 2 and 3 ranks,
// and on 4 and 8 under the label long.
#include "many_ranks_scene.h"

#include <dem/parallel/distribution.h>

namespace
{
using namespace many_ranks;

Scene of_spheres()
{
  Scene scene;
  scene.parameters = parameters();
  scene.parameters.geometry.geometry = dem::ContactGeometry::sphere;
  return scene;
}

/// With each other and with the walls.
Scene of_surfaces()
{
  Scene scene;
  scene.parameters = parameters();
  scene.parameters.geometry.geometry = dem::ContactGeometry::surface;
  scene.parameters.geometry.wall_geometry = dem::ContactGeometry::surface;
  scene.has_shapes = true;
  scene.n_along = 4;
  return scene;
}

void expect_same_bits(const Scene &scene, std::int64_t partition_interval)
{
  Twins twins(scene);
  twins.shared.set_partition_interval(partition_interval);
  for (int part = 0; part < 5; ++part)
  {
    SCOPED_TRACE(part);
    twins.advance(scene, scene.n_steps / 5);
    twins.expect_same_bits();
    if (part == 1)
      twins.restore_shared(scene, partition_interval);
    if (part == 3)
      twins.restore_alone(scene);
  }
  for (const dem::FacetBoundary &lid : surfaces(twins.alone))
    EXPECT_NE(lid.work(), 0.);
  if (twins.all->size() == 1)
    return;
  EXPECT_GT(twins.shared.distribution().n_partitions(), 0);
  std::array largest{double(twins.shared.distribution().exchange().n_ghosts())};
  twins.all->max(largest);
  EXPECT_GT(largest[0], 0.);
}

TEST(ManyRanks, SpheresInAClosingBox)
{
  expect_same_bits(of_spheres(), 0);
}

/// Forces grow a hundredfold in a few steps: loads are added again with a
/// larger spacing, on all ranks.
TEST(ManyRanks, BlowInAGentlePacking)
{
  Scene scene = of_spheres();
  scene.jitter_speed = 1e-4;
  scene.n_steps = 500;
  Twins twins(scene);
  twins.advance(scene, 1000);
  for (dem::Engine *engine : {&twins.shared, &twins.alone})
  {
    dem::ParticleSystem &particles = engine->particles();
    for (std::size_t k = 0; k < particles.n_owned(); ++k)
      if (particles.id[k] % 50 == 7)
        particles.velocity(k) = {10., -20., -30.};
  }
  for (int part = 0; part < 5; ++part)
  {
    twins.advance(scene, scene.n_steps / 5);
    twins.expect_same_bits();
  }
}

TEST(ManyRanks, BoxesAreMadeAgainAtEveryMigration)
{
  Scene scene = of_spheres();
  scene.jitter_speed = 3.;
  expect_same_bits(scene, 1);
}

TEST(ManyRanks, LocalDampingAndDmtAttraction)
{
  Scene scene = of_spheres();
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
  expect_same_bits(of_surfaces(), 1);
}

TEST(ManyRanks, SpheresInATurningDrum)
{
  Scene scene = of_spheres();
  scene.has_drum = true;
  expect_same_bits(scene, 1);
}

TEST(ManyRanks, TrueSurfacesInATurningDrum)
{
  Scene scene = of_surfaces();
  scene.has_drum = true;
  expect_same_bits(scene, 1);
}

TEST(ManyRanks, SpheresUnderASheet)
{
  Scene scene = of_spheres();
  scene.has_sheet = true;
  expect_same_bits(scene, 1);
}

TEST(ManyRanks, RadiiTowardsASheet)
{
  Scene scene;
  scene.parameters = parameters();
  scene.parameters.geometry.wall_geometry = dem::ContactGeometry::radial;
  scene.parameters.surface.law = "hertz";
  scene.has_shapes = true;
  scene.n_along = 5;
  scene.has_sheet = true;
  expect_same_bits(scene, 2);
}

TEST(ManyRanks, TrueSurfacesUnderASheet)
{
  Scene scene = of_surfaces();
  scene.has_sheet = true;
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
  scene.n_steps = std::min(scene.n_steps, 900);
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
  Scene scene = of_surfaces();
  scene.n_steps = 500;
  expect_same_events(scene);
}

TEST(ManyRanks, CornersBreakOffInATurningDrum)
{
  Scene scene;
  scene.parameters = parameters();
  scene.parameters.geometry.wall_geometry = dem::ContactGeometry::radial;
  scene.has_drum = true;
  expect_same_events(scene);
}

TEST(ManyRanks, CornersOfTrueSurfacesBreakOffInATurningDrum)
{
  Scene scene = of_surfaces();
  scene.has_drum = true;
  expect_same_events(scene);
}

TEST(ManyRanks, CornersBreakOffUnderASheet)
{
  Scene scene;
  scene.parameters = parameters();
  scene.parameters.geometry.wall_geometry = dem::ContactGeometry::radial;
  scene.has_sheet = true;
  expect_same_events(scene);
}

TEST(ManyRanks, CornersOfTrueSurfacesBreakOffUnderASheet)
{
  Scene scene = of_surfaces();
  scene.n_steps = 500;
  scene.has_sheet = true;
  expect_same_events(scene);
}

/// Fewer particles than ranks, and ranks whose boxes are empty.
TEST(ManyRanks, OneParticle)
{
  Scene scene = of_spheres();
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
  Scene scene = of_spheres();
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
  Scene scene = of_spheres();
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
