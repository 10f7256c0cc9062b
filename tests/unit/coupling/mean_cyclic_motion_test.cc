#include "dem_scene.h"

#include <coupling/mean_cyclic_motion.h>
#include <dem/engine_boundaries.h>

#include <gtest/gtest.h>

// The motion of a specimen over some cycles, observed and repeated.
namespace
{
using coupling::MeanCyclicMotion;
using dem::Vec3;

constexpr double radius = 0.01, time_step = 1e-6;

/// Eight balls that press on each other, a ninth apart, under a plate that
/// presses on none.
struct Scene
{
  dem::Engine engine{support::bare_parameters()};
  coupling::Exchange exchange{{}};
  coupling::TriaxialCell *cell = nullptr;
  std::size_t top = 0;

  Scene()
  {
    constexpr double apart = 1.99 * radius;
    for (int k = 0; k < 8; ++k)
      support::add_sphere(engine, radius,
                          apart * Vec3(k % 2, k / 2 % 2, k / 4));
    support::add_sphere(engine, radius, Vec3(0.06, 0.07, 0.01));
    top = dem::add_plane(engine, Vec3(0., 0., 0.1), -Vec3::UnitZ());
    auto body = std::make_unique<coupling::TriaxialCell>(1., 0.1, std::nullopt);
    cell = body.get();
    auto adapter = coupling::adapter_of(*cell, top, {}, engine);
    exchange.add(std::move(body), std::move(adapter), engine);
    engine.advance(time_step);
  }

  /// u = F (x, 1) of all particles, and the plate up by a millimetre.
  MeanCyclicMotion affine(const Eigen::Matrix<double, 3, 4> &field) const
  {
    MeanCyclicMotion drift;
    for (const dem::ParticleState &particle : engine.particles().state)
      drift.shift.push_back(field * particle.position.homogeneous());
    drift.turn.assign(drift.shift.size(), Vec3::Zero());
    drift.planes = drift.nodes = {1e-3 * Vec3::UnitZ()};
    return drift;
  }
};

Eigen::Matrix<double, 3, 4> field()
{
  Eigen::Matrix<double, 3, 4> f;
  f << 0.01, 0.002, 0., 1e-4, -0.003, 0.02, 0.001, 0., 0., 0.004, 0.03, -2e-4;
  return f;
}

TEST(MeanCyclicMotion, IsTheMeanMotionOfACycle)
{
  Scene scene;
  const coupling::Pose from = coupling::pose_of(scene.engine, *scene.cell);
  coupling::Pose to = from;
  to.position[3] += Vec3(4e-3, 0., -2e-3);
  const Vec3 turn = Vec3(0.2, -0.1, 0.3);
  to.orientation[3] =
      Eigen::AngleAxisd(turn.norm(), turn.normalized()) * from.orientation[3];
  to.orientation[3].coeffs() *= -1.; // the same orientation
  to.planes[0].z() -= 1e-3;
  to.radius += 2e-3;
  const MeanCyclicMotion drift = coupling::mean_motion_between(from, to, 4.);
  EXPECT_LT((drift.shift[3] - Vec3(1e-3, 0., -0.5e-3)).norm(), 1e-15);
  EXPECT_LT((drift.turn[3] - 0.25 * turn).norm(), 1e-12);
  EXPECT_NEAR(drift.planes[0].z(), -0.25e-3, 1e-15);
  EXPECT_NEAR(drift.widening, 0.5e-3, 1e-15);
  EXPECT_EQ(drift.shift[2], Vec3::Zero());
}

// Where the fit has as many unknowns as there are, it is exact.
TEST(MeanCyclicMotion, RattlersGoWithTheOthers)
{
  Scene scene;
  MeanCyclicMotion drift = scene.affine(field());
  const Vec3 right = drift.shift[8];
  drift.shift[8] = Vec3(1., 2., 3.);
  drift.turn[8] = Vec3(0.1, 0., 0.);
  const Vec3 touched = drift.shift[5];
  coupling::calm_rattlers(scene.engine, drift);
  EXPECT_LT((drift.shift[8] - right).norm(), 1e-9 * right.norm());
  EXPECT_EQ(drift.turn[8], Vec3::Zero());
  EXPECT_EQ(drift.shift[5], touched);
}

TEST(MeanCyclicMotion, MovesAllAndLeavesItAtRest)
{
  Scene scene;
  const MeanCyclicMotion drift = scene.affine(0.1 * field());
  const coupling::Pose from = coupling::pose_of(scene.engine, *scene.cell);
  const double moved = coupling::move_along(
      drift, {2.5, 100, time_step}, scene.exchange, *scene.cell, scene.engine);
  const coupling::Pose to = coupling::pose_of(scene.engine, *scene.cell);
  EXPECT_NEAR(moved, 2.5, 1e-12);
  for (std::size_t k = 0; k < 9; ++k)
  {
    EXPECT_LT((to.position[k] - from.position[k] - 2.5 * drift.shift[k]).norm(),
              1e-12);
    EXPECT_EQ(scene.engine.particles().velocity(k), Vec3::Zero());
  }
  EXPECT_NEAR(scene.cell->plate().height(), 0.1025, 1e-12);
  EXPECT_NEAR(dem::planes(scene.engine)[scene.top].point.z(), 0.1025, 1e-12);
}

// All towards the origin, by a tenth of their distance: deep into each other.
TEST(MeanCyclicMotion, EndsWhereParticlesPressTooHard)
{
  Scene scene;
  Eigen::Matrix<double, 3, 4> inward = Eigen::Matrix<double, 3, 4>::Zero();
  inward.leftCols<3>() = -0.1 * dem::Mat3::Identity();
  const double before = scene.engine.energy().elastic;
  const double moved =
      coupling::move_along(scene.affine(inward), {1., 1000, time_step},
                           scene.exchange, *scene.cell, scene.engine);
  EXPECT_GT(moved, 0.);
  EXPECT_LT(moved, 0.2);
  EXPECT_LT(scene.engine.energy().elastic, 6. * before);
}
} // namespace
