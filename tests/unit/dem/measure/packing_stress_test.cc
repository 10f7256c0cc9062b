#include "dem_scene.h"

#include <dem/control/box_servo.h>
#include <dem/engine_boundaries.h>
#include <dem/integrate/time_step.h>
#include <dem/measure/assembly.h>
#include <dem/measure/region_stress.h>
#include <dem/packing/gradation.h>
#include <dem/packing/insertion.h>

#include <gtest/gtest.h>

namespace
{
const dem::Vec3 target(30e3, 35e3, 45e3); // Pa

/// Particles of all sizes, without friction on the walls, and six servo planes.
struct Packing
{
  dem::Engine engine;
  dem::BoxPlanes box;
};

Packing loose_packing()
{
  dem::EngineParameters p;
  p.particle.friction = 0.1;
  p.wall.normal_stiffness = 1e7;
  p.wall.shear_stiffness = 0.85e7;
  p.wall.friction = 0.;
  p.surface = p.wall;
  p.breakage.is_active = false;
  p.local_damping = 0.3;
  dem::Random random(5);
  const double volume = 3e-5, side = std::cbrt(volume / 0.35);
  const auto bodies =
      dem::draw_particles({{8e-3, 14e-3}, {0., 1.}}, volume, {}, random);
  const auto placements = dem::insert_particles(
      bodies, {dem::Vec3::Zero(), dem::Vec3::Constant(side)}, random);
  Packing packing{dem::Engine(p), {}};
  for (std::size_t k = 0; k < bodies.size(); ++k)
    packing.engine.add_particle(bodies[k], placements[k].position,
                                placements[k].orientation);
  packing.box = dem::add_box(packing.engine, dem::Vec3::Zero(),
                             dem::Vec3::Constant(side));
  return packing;
}

/// To rest under the target.
void compact(Packing &packing)
{
  dem::Engine &engine = packing.engine;
  dem::BoxServo servo(packing.box, {});
  for (int d = 0; d < 3; ++d)
    servo.follow(d, target[d]);
  const double dt =
      0.5 * dem::critical_step(engine.parameters(), engine.particles()).step;
  const auto is_settled = [&]
  {
    const dem::Vec3 stress = dem::box_stress(engine, packing.box);
    return (stress - target).cwiseQuotient(target).cwiseAbs().maxCoeff() <
               1e-2 &&
           dem::unbalanced_force_ratio(engine) < 3e-4;
  };
  do
    for (int step = 0; step < 200; ++step)
    {
      servo.update(engine, dt);
      engine.advance(dt);
    }
  while (!is_settled() && engine.time() < 0.5);
}
} // namespace

// In equilibrium the stress of all that is between frictionless walls is that
// on the walls, whatever the particles among themselves do.
TEST(MeanStress, OfAPackingIsThatOnItsWalls)
{
  Packing packing = loose_packing();
  compact(packing);
  const dem::Engine &engine = packing.engine;
  const dem::Network network = dem::contact_network_of(engine);
  dem::Vec3 lower, upper;
  for (int d = 0; d < 3; ++d)
  {
    const auto &[low, high] = packing.box[static_cast<std::size_t>(d)];
    lower[d] = dem::planes(engine)[low].point[d];
    upper[d] = dem::planes(engine)[high].point[d];
  }
  const dem::Prism all = dem::prism_of(lower, upper);
  const dem::Mat3 stress = dem::mean_stress(all, engine.particles(), network);
  const dem::Vec3 walls = dem::box_stress(engine, packing.box);
  // Forces out of balance: 3e-4 of a contact force on every particle.
  for (int d = 0; d < 3; ++d)
    EXPECT_NEAR(stress(d, d), walls[d], 3e-3 * walls[d]);
  // The particles hold all of it, each its part by its volume.
  dem::Mat3 sum = dem::Mat3::Zero();
  const std::vector<dem::Mat3> particles =
      dem::particle_stress(engine.particles(), network);
  for (std::size_t i = 0; i < particles.size(); ++i)
    sum += engine.particles().shape[i].volume / all.volume() * particles[i];
  EXPECT_LT((sum - stress).norm(), 1e-9 * stress.norm());
  // Any horizontal layer carries the same force along z.
  dem::Prism layer = all;
  layer.low += 0.4 * (upper.z() - lower.z());
  layer.high -= 0.35 * (upper.z() - lower.z());
  EXPECT_NEAR(dem::mean_stress(layer, engine.particles(), network)(2, 2),
              walls.z(), 3e-3 * walls.z());
}
