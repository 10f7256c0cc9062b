#include "dem_scene.h"

#include <coupling/network_state.h>

#include <gtest/gtest.h>

// Measures of a specimen between rigid sides.
namespace
{
using dem::Vec3;

constexpr double radius = 0.01;
const Vec3 low(-0.02, -0.02, 0.), high(0.02, 0.02, 0.06);

/// Twelve balls that fill a box and press on each other and on its sides, and
/// some of them off the lattice, so that forces are not in balance.
struct Scene
{
  dem::Engine engine{support::bare_parameters()};
  dem::SpecimenWalls walls{dem::add_box(engine, low, high)};
  coupling::ConfiningLoad load;

  Scene()
  {
    for (int k = 0; k < 12; ++k)
    {
      const double shift = 2e-5 * (k % 3 - 1); // no contact opens
      support::add_sphere(engine, 1.005 * radius,
                          Vec3(k % 2 - 0.5, k / 2 % 2 - 0.5, k / 4 + 0.5) *
                                  (2. * radius) +
                              Vec3(shift, -0.5 * shift, 0.7 * shift));
    }
    engine.advance(1e-8);
  }
  coupling::EnclosedSpecimen specimen() const { return {engine, walls}; }
};

TEST(EnclosedSpecimen, HasTheSpaceOfItsWalls)
{
  const Scene scene;
  const double volume = 0.04 * 0.04 * 0.06;
  EXPECT_NEAR(coupling::enclosed_volume(scene.specimen()), volume,
              1e-12 * volume);
  EXPECT_NEAR(coupling::space_of(scene.specimen()).volume(), volume,
              1e-12 * volume);
  // A quarter of the width is less than the largest particle.
  EXPECT_NEAR(coupling::skin_of(scene.specimen()), 0.01, 1e-15);
  for (const double area : coupling::section_areas(scene.specimen()))
    EXPECT_NEAR(area, 0.04 * 0.04, 1e-15);
}

// An identity, for any origin: nothing but round-off is left.
TEST(StressBalance, ParticlesBearRigidSides)
{
  Scene scene;
  for (const Vec3 &origin : {Vec3(0., 0., 0.), Vec3(0.3, -0.2, 0.1)})
  {
    scene.load.origin = origin;
    const coupling::StressBalance sums =
        coupling::stress_balance(scene.specimen(), scene.load);
    const double scale = sums.particles.cwiseAbs().maxCoeff();
    EXPECT_GT(coupling::axial(sums.particles), 0.);
    EXPECT_GT(sums.unrest.cwiseAbs().maxCoeff(), 1e-4 * scale);
    EXPECT_LT(
        (sums.particles - sums.boundary - sums.unrest).cwiseAbs().maxCoeff(),
        1e-10 * scale);
    EXPECT_EQ(sums.membrane, dem::Mat3::Zero());
  }
}

TEST(NetworkState, TakesTheStressesOfWallsAndParticles)
{
  const Scene scene;
  const coupling::StressBalance balance =
      coupling::stress_balance(scene.specimen(), scene.load);
  const coupling::NetworkState state =
      coupling::network_state(scene.specimen(), balance, {3., 2.});
  EXPECT_EQ(state.wall_axial_stress, 3.);
  EXPECT_EQ(state.wall_lateral_stress, 2.);
  EXPECT_EQ(state.specimen_axial_stress, coupling::axial(balance.particles));
  EXPECT_EQ(state.specimen_lateral_stress,
            coupling::lateral(balance.particles));
  // Twelve balls, twenty contacts; none has fewer than three.
  EXPECT_NEAR(state.coordination_number, 40. / 12., 1e-12);
  EXPECT_GT(state.mean_contact_force, 0.);
  EXPECT_GT(state.inside_axial_stress, 0.);
}
} // namespace
