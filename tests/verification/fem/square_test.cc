#include "flat_mesh.h"
#include "relax.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace
{
constexpr double half_side = 0.5, modulus = 1e6, thickness = 1e-3,
                 density = 1000.;

/// Deflection of the middle over a, held along the rim, q = p a / (E h).
double middle_deflection(double q, int n)
{
  // sigma = 0.46 E q^(2/3) at the middle; damped a little below critical.
  const double speed =
      std::sqrt(0.46 * modulus * std::pow(q, 2. / 3.) / density);
  const double frequency =
      speed * std::numbers::pi / (std::sqrt(2.) * half_side);
  fem::MembraneParameters p;
  p.youngs_modulus = modulus;
  p.poisson_ratio = 0.45;
  p.thickness = thickness;
  p.density = density;
  p.mass_damping = 2. * frequency;
  fem::Membrane membrane(p, support::flat_square(2. * half_side, n));
  membrane.tie(support::square_rim(n));

  // A start near the result, so that the slack membrane need not find it.
  std::vector<Eigen::Vector3d> start = membrane.mesh().nodes;
  for (Eigen::Vector3d &node : start)
    node.z() = -0.677 * half_side * std::cbrt(q) *
               std::sin(0.5 * std::numbers::pi * node.x() / half_side) *
               std::sin(0.5 * std::numbers::pi * node.y() / half_side);
  membrane.set_positions(start);
  membrane.set_pressure(q * modulus * thickness / half_side);
  support::advance(membrane,
                   {0.8 * membrane.stable_time_step(), 10. / frequency});
  EXPECT_LT(membrane.unbalanced_force_ratio(), 1e-4);
  const auto middle = static_cast<std::size_t>((n + 1) * (n + 1) / 2);
  return -membrane.positions()[middle].z() / half_side;
}

// Large deflection of a square without bending stiffness after Foeppl:
// w0 = C a q^(1/3), C = 0.6769882854348167 at nu = 0.45 from an independent
// spectral minimisation of the energy (good to 2e-5).
TEST(SquareMembrane, DeflectsAsFoepplSays)
{
  const double q = 1e-5, exact = 0.6769882854348167 * std::cbrt(q);
  const double coarse = middle_deflection(q, 8) / exact;
  const double middle = middle_deflection(q, 16) / exact;
  const double fine = middle_deflection(q, 32) / exact;
  std::printf("w0 / exact = %.6f %.6f %.6f, order %.3f, limit %.6f\n", coarse,
              middle, fine, std::log2((middle - coarse) / (fine - middle)),
              (4. * fine - middle) / 3.);
  EXPECT_NEAR(fine, 1., 0.01);
  // Foeppl drops w'^2 against one: (w0 / a)^2 = 2e-4. What is left after
  // extrapolation is of that size; one per cent of p, E or h moves w0
  // by 3.3e-3, of nu by 2e-3.
  EXPECT_NEAR((4. * fine - middle) / 3., 1., 5e-4);
}
} // namespace
