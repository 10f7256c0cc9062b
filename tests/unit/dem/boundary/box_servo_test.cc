#include "dem_scene.h"

#include <dem/boundary/box_servo.h>
#include <dem/integrate/time_step.h>
#include <dem/packing/gradation.h>
#include <dem/packing/insertion.h>

#include <gtest/gtest.h>

namespace
{
dem::EngineParameters packing_parameters()
{
  dem::EngineParameters p; // the article's stones
  p.stone.friction = 0.1;
  p.wall.normal_stiffness = 1e7;
  p.wall.shear_stiffness = 0.85e7;
  p.surface = p.wall;
  p.breakage.is_active = false;
  p.local_damping = 0.3;
  return p;
}

/// Largest relative error of the stress on the three axes [-].
double stress_error(const dem::Engine &engine, const dem::BoxPlanes &box,
                    const dem::Vec3 &target)
{
  return (dem::box_stress(engine, box) - target)
      .cwiseQuotient(target)
      .cwiseAbs()
      .maxCoeff();
}
} // namespace

// From a loose gas to a packing at rest, more stress along z.
TEST(BoxServo, CompactsSpheresToTheirStress)
{
  dem::Random random(4);
  const auto bodies =
      dem::draw_stones({{8e-3, 14e-3}, {0., 1.}}, 5e-5, {}, random);
  const double side = std::cbrt(5e-5 / 0.3);
  const auto places = dem::insert_stones(
      bodies, {dem::Vec3::Zero(), dem::Vec3::Constant(side)}, random);
  dem::Engine engine(packing_parameters());
  for (std::size_t k = 0; k < bodies.size(); ++k)
    engine.add_stone(bodies[k], places[k].position, places[k].orientation);
  const dem::BoxPlanes box =
      dem::add_box(engine, dem::Vec3::Zero(), dem::Vec3::Constant(side));
  dem::BoxServo servo(box, {});
  const dem::Vec3 target(30e3, 30e3, 40e3);
  for (int d = 0; d < 3; ++d)
    servo.follow(d, target[d]);
  const double dt =
      0.5 * dem::critical_step(engine.parameters(), engine.particles()).step;
  const auto is_settled = [&](double error, double ratio)
  {
    return stress_error(engine, box, target) < error &&
           dem::unbalanced_force_ratio(engine.particles(), engine.pairs()) <
               ratio;
  };
  const auto advance = [&](int n_steps)
  {
    for (int step = 0; step < n_steps; ++step)
    {
      servo.update(engine, dt);
      engine.advance(dt);
    }
  };
  // Small rearrangements go on for a while after the first rest.
  do
    advance(200);
  while (!is_settled(2e-3, 1e-4) && engine.time() < 0.5);
  EXPECT_TRUE(is_settled(2e-3, 1e-4))
      << stress_error(engine, box, target) << ", "
      << dem::unbalanced_force_ratio(engine.particles(), engine.pairs());
  advance(3000);
  EXPECT_TRUE(is_settled(0.02, 1e-3));
  const dem::Vec3 size = dem::box_size(engine, box);
  const double solid = 5e-5 / size.prod();
  EXPECT_GT(solid, 0.45);
  EXPECT_LT(solid, 0.66);
  // The books of the whole compaction.
  EXPECT_NEAR(support::energy_residual(engine), 0.,
              0.01 * engine.energy().plane_work);
}

// Forces on opposite planes, over the face: signs and areas.
TEST(BoxServo, StressIsForceOverFace)
{
  dem::EngineParameters p = support::bare_parameters();
  dem::Engine engine(p);
  const dem::Vec3 size(0.02, 0.05, 0.08);
  const dem::BoxPlanes box = dem::add_box(engine, dem::Vec3::Zero(), size);
  support::add_sphere(engine, 0.01 + 1e-6, {0.01, 0.02, 0.03});
  engine.advance(1e-9);
  EXPECT_NEAR(dem::box_stress(engine, box).x(),
              p.wall.normal_stiffness * 1e-6 / (0.05 * 0.08), 1e-6 * 25e3);
  EXPECT_EQ(dem::box_stress(engine, box).y(), 0.);
  EXPECT_EQ(dem::box_stress(engine, box).z(), 0.);
  EXPECT_LT((dem::box_size(engine, box) - size).norm(), 1e-15);
}

// No stone, no stress: the planes close at no more than their top speed, and
// an axis that is let go stands still.
TEST(BoxServo, SpeedIsLimitedAndReleased)
{
  dem::Engine engine(support::bare_parameters());
  const dem::BoxPlanes box =
      dem::add_box(engine, dem::Vec3::Zero(), dem::Vec3::Ones());
  dem::BoxServo servo(box, {.response_time = 1e-6, .max_speed = 0.3});
  servo.follow(0, 1e5);
  servo.follow(1, 1e5);
  servo.release(engine, 1);
  servo.update(engine, 1e-6);
  EXPECT_EQ(engine.planes()[box[0][0]].velocity, dem::Vec3(0.3, 0., 0.));
  EXPECT_EQ(engine.planes()[box[0][1]].velocity, dem::Vec3(-0.3, 0., 0.));
  EXPECT_EQ(engine.planes()[box[1][0]].velocity, dem::Vec3(0., 0., 0.));
  EXPECT_EQ(engine.planes()[box[2][1]].velocity, dem::Vec3(0., 0., 0.));
}
