#include "flat_mesh.h"
#include "relax.h"

#include <gtest/gtest.h>

#include <cmath>

namespace
{
constexpr int n = 8;

/// A flat square stretched by 20 % and held at its rim: at rest, in tension.
fem::Membrane stretched_square()
{
  fem::Membrane membrane(fem::MembraneParameters(),
                         support::flat_square(0.1, n));
  membrane.tie(support::square_rim(n));
  std::vector<Eigen::Vector3d> stretched = membrane.mesh().nodes;
  for (Eigen::Vector3d &x : stretched)
    x *= 1.2;
  membrane.set_positions(stretched);
  return membrane;
}

/// Largest kinetic energy after a kick of 1e-6 m/s to a few nodes [J].
double largest_kinetic(double share_of_stable_step)
{
  fem::Membrane membrane = stretched_square();
  const double time_step = share_of_stable_step * membrane.stable_time_step();
  auto loads = support::random_vectors(membrane.n_nodes(), 1e-6, 9);
  double largest = 0.;
  for (int step = 0; step < 400; ++step)
  {
    membrane.begin_step(time_step);
    membrane.end_step(loads, time_step);
    if (step == 0)
      std::fill(loads.begin(), loads.end(), Eigen::Vector3d::Zero());
    largest = std::max(largest, membrane.energy().kinetic);
    if (step == 0 || largest < 1e-3) // else unstable, and soon not finite
      continue;
    break;
  }
  return largest;
}

// Just below the step the kick only swings; above, at r times the step, it
// grows by 2 r^2 - 1 + sqrt((2 r^2 - 1)^2 - 1) per step: 1.5 at r = 1.02.
TEST(StableStep, DividesStableFromUnstable)
{
  const double kicked = largest_kinetic(0.1);
  EXPECT_GT(kicked, 0.);
  EXPECT_LT(kicked, 1e-10);
  EXPECT_LT(largest_kinetic(0.9), 1e-10);
  EXPECT_LT(largest_kinetic(0.98), 1e-9);
  EXPECT_GT(largest_kinetic(1.02), 1e-3);
  EXPECT_GT(largest_kinetic(1.2), 1e-3);
}

// Tension stiffens: S adds to the tangent, and stretches enter it squared.
TEST(StableStep, ShrinksUnderTension)
{
  const fem::Membrane slack(fem::MembraneParameters(),
                            support::flat_square(0.1, n));
  EXPECT_LT(stretched_square().stable_time_step(),
            0.85 * slack.stable_time_step());
}

TEST(StableStep, IsInfiniteWithoutFreeNodes)
{
  fem::Membrane held(fem::MembraneParameters(), support::flat_square(0.1, 1));
  held.tie({0, 1, 2, 3});
  EXPECT_TRUE(std::isinf(held.stable_time_step()));
}
} // namespace
