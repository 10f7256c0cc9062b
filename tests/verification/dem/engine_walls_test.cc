#include "dem_scene.h"

#include <dem/packing/random.h>

#include <gtest/gtest.h>

#include <shape/test_shapes.h>

// Stones that meet drums and facets with their true surfaces.
namespace
{
using dem::Vec3;

dem::EngineParameters surface_parameters()
{
  dem::EngineParameters p = support::bare_parameters();
  p.geometry.geometry = p.geometry.wall_geometry =
      dem::ContactGeometry::surface;
  // Of third power is what the expansions are out by.
  p.geometry.refresh_tolerance = 5e-4;
  p.wall.normal_stiffness = 1e6;
  p.wall.shear_stiffness = 0.85e6;
  p.surface = p.wall;
  p.search_margin = 1e-3;
  return p;
}

std::shared_ptr<const dem::Coefficients> rough_stone(unsigned seed)
{
  return std::make_shared<const dem::Coefficients>(
      dem::test::random_stone(10, seed));
}

dem::Drum small_drum()
{
  dem::Drum drum;
  drum.radius = 0.05;
  drum.length = 0.06;
  drum.shelf_height = 0.012;
  drum.shelf_thickness = 0.006;
  return drum;
}

/// A stone thrown about inside.
void throw_stone(dem::Engine &engine, unsigned seed)
{
  dem::Random random(seed);
  engine.add_stone(dem::make_body(rough_stone(seed), 0.01), Vec3::Zero(),
                   random.rotation());
  for (int d = 0; d < 3; ++d)
  {
    engine.particles().velocity(0)[d] = 2. * (random.uniform() - 0.5);
    engine.particles().spin(0)[d] = 60. * (random.uniform() - 0.5);
  }
}

/// What a run has done with its energy.
struct EnergyRecord
{
  double drift = 0.;      ///< largest, over the energy [-]
  double shape_work = 0.; ///< at the end, over the energy [-]
  double stored = 0.;     ///< most, over the energy [-]
};

EnergyRecord run(dem::Engine &engine, double time_step, double end)
{
  const double start = engine.energy().kinetic;
  EnergyRecord record;
  while (engine.time() < end)
  {
    engine.advance(time_step);
    const dem::EngineEnergy e = engine.energy();
    record.stored = std::max(record.stored, e.elastic / start);
    record.drift =
        std::max(record.drift, std::abs((e.kinetic + e.elastic) / start - 1.));
  }
  record.shape_work = engine.energy().shape_work / start;
  return record;
}
} // namespace

// Springs alone, over some ten hits on the cylinder, the ends and the shelf:
// what is left goes with the square of the step, 1.2e-4 at most here.
TEST(SurfaceOnDrum, StoneKeepsItsEnergy)
{
  for (unsigned seed = 2; seed <= 5; ++seed)
  {
    dem::Engine engine(surface_parameters());
    engine.set_drum(small_drum());
    throw_stone(engine, seed);
    const EnergyRecord record = run(engine, 2e-6, 0.12);
    EXPECT_GT(record.stored, 0.1) << seed;
    EXPECT_LT(record.drift, 3e-4) << seed;
    EXPECT_LT(std::abs(record.shape_work), 1e-3) << seed;
    EXPECT_EQ(engine.spot_events().n_jumps, 0);
    EXPECT_EQ(engine.spot_events().n_ended, 0);
    EXPECT_EQ(engine.spot_events().n_late, 0);
  }
}
