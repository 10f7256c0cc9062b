#include "solid_scene.h"

#include <gtest/gtest.h>

#include <complex>

namespace
{
using Vector = Eigen::Vector3d;

// All in units of the disc: radius 1, G = 1, rho = 1, so a0 = omega.
constexpr double poisson = 0.25;
const fem::SolidLayer ground{2. * (1. + poisson), poisson, 1.};
const double unit_stiffness = 4. / (1. - poisson); ///< 4 G r / (1 - nu)

struct Fineness
{
  int n = 4;
  double edge = 0.05;    ///< cells at the edge
  double far_cell = 0.4; ///< longest cell along a wave
  double reach = 8.;
  double duration = 40.;
};

/// Widths that grow until they reach the longest one allowed.
std::vector<double> widths(double first, double growth, double longest,
                           double length)
{
  std::vector<double> result;
  double sum = 0.;
  for (double width = first; sum < length;
       width = std::min(longest, growth * width))
  {
    result.push_back(width);
    sum += width;
  }
  return result;
}

fem::Solid ground_block(const Fineness &fine)
{
  fem::QuarterCylinder block;
  block.n_square = fine.n;
  // From the square, 0.34 of the diagonal away, down to the edge.
  double sum = 0.;
  for (double width = fine.edge; sum < 0.36; width *= 1.6)
  {
    block.inner.insert(block.inner.begin(), width);
    sum += width;
  }
  block.outer = widths(fine.edge, 1.6, fine.far_cell, fine.reach - 1.);
  block.heights = widths(fine.edge, 1.6, fine.far_cell, fine.reach);
  fem::SolidParameters p;
  p.layers = {ground};
  fem::Solid solid(p, fem::quarter_cylinder_mesh(block));
  support::stand_in_a_half_space(solid);
  return solid;
}

using Impedance = std::complex<double>;

/// k + i a0 c of a smooth, rigid, massless disc, from its answer to one pulse
/// of displacement exp(-(t - 4)^2).
std::vector<Impedance> disc_impedance(const Fineness &fine,
                                      const std::vector<double> &a0)
{
  fem::Solid solid = ground_block(fine);
  std::vector<std::int32_t> disc;
  for (const std::int32_t node :
       fem::boundary_nodes(solid.mesh(), fem::z_upper))
    if (solid.mesh().nodes[static_cast<std::size_t>(node)].head<2>().norm() <
        1. + 1e-9)
      disc.push_back(node);
  double mass = 0.;
  for (const std::int32_t node : disc)
  {
    solid.fix_node(node, {false, false, true});
    mass += 4. * solid.nodal_mass()[static_cast<std::size_t>(node)];
  }
  const double dt = 0.9 * solid.stable_time_step().time_step;
  const auto pulse = [](double t) { return std::exp(-(t - 4.) * (t - 4.)); };
  const auto loads = support::no_loads(solid);
  std::vector<Impedance> force(a0.size()), motion(a0.size());
  double last = pulse(0.), now = last;
  const double duration = fine.duration;
  for (double t = dt; t < duration; t += dt)
  {
    const double next = pulse(t + dt);
    const double speed = (now - last) / dt;
    for (const std::int32_t node : disc)
      solid.set_support_velocity(node, Vector(0., 0., speed));
    solid.begin_step(dt);
    solid.end_step(loads, dt);
    double push = mass * (next - 2. * now + last) / (dt * dt);
    for (const std::int32_t node : disc)
      push -= 4. * solid.reaction(node).z();
    for (std::size_t k = 0; k < a0.size(); ++k)
    {
      const Impedance wave = std::exp(Impedance(0., -a0[k] * t));
      force[k] += push * wave;
      motion[k] += now * wave;
    }
    last = now;
    now = next;
  }
  for (std::size_t k = 0; k < a0.size(); ++k)
    force[k] /= motion[k] * unit_stiffness;
  return force;
}

// Exact k and c at nu = 0.25 from the Fredholm equation of the dual integral
// equations (error below 1e-6), and Lysmer's analogue k = 1, c = 0.85.
struct Exact
{
  double a0, k, c;
};
const std::vector<Exact> exact{{0.25, 0.9922769337537021, 0.7928452641103787},
                               {0.50, 0.9695735136743848, 0.8012342773421387},
                               {0.75, 0.9333676800693513, 0.8151603373053368},
                               {1.00, 0.886354911852747, 0.8344027465196572},
                               {1.50, 0.7778111447587028, 0.8860231040223588},
                               {2.00, 0.6902019960291383, 0.94458089211894}};

std::vector<double> frequencies()
{
  std::vector<double> a0;
  for (const Exact &row : exact)
    a0.push_back(row.a0);
  return a0;
}

// Nothing has come back from the far sides at t = 12, when the disc has long
// been at rest: a half-space. The edge is singular, of first order in its
// cells, so the limit of two meshes counts. What is left, 0.6 %, is the
// polygon of six chords to a right angle and a quarter metre of cells.
TEST(DiscImpedance, OverFrequencyBeforeAnythingReturns)
{
  const auto coarse = disc_impedance({3, 0.05, 0.25, 9.5, 12.}, frequencies());
  const auto fine = disc_impedance({3, 0.025, 0.25, 9.5, 12.}, frequencies());
  for (std::size_t row = 0; row < exact.size(); ++row)
  {
    const auto [a0, k, c] = exact[row];
    const Impedance limit = 2. * fine[row] - coarse[row];
    std::printf("a0 %.2f: k %.4f (%+.2f %%, Lysmer %+.1f %%), c %.4f "
                "(%+.2f %%, Lysmer %+.1f %%)\n",
                a0, limit.real(), 100. * (limit.real() / k - 1.),
                100. * (1. / k - 1.), limit.imag() / a0,
                100. * (limit.imag() / a0 / c - 1.), 100. * (0.85 / c - 1.));
    EXPECT_NEAR(limit.real(), k, 7e-3 * k);
    EXPECT_NEAR(limit.imag() / a0, c, 7e-3 * c);
  }
}

// The dashpots of a near boundary are exact for waves that meet it at right
// angles only; surface waves come back to a disc in the middle of a round
// block. Measured here: what a long record of such a block is good for.
TEST(LongDiscImpedance, WithAbsorbingSidesNearby)
{
  for (const double reach : {8., 16.})
  {
    const auto found =
        disc_impedance({3, 0.05, 0.4, reach, 80.}, frequencies());
    double worst = 0.;
    for (std::size_t row = 0; row < exact.size(); ++row)
    {
      const auto [a0, k, c] = exact[row];
      const Impedance truth(k, a0 * c);
      const double error = std::abs(found[row] - truth) / std::abs(truth);
      std::printf("reach %.0f a0 %.2f: k %.4f of %.4f, c %.4f of %.4f\n", reach,
                  a0, found[row].real(), k, found[row].imag() / a0, c);
      worst = std::max(worst, error);
    }
    std::printf("reach %.0f: worst error of the impedance %.1f %%\n", reach,
                100. * worst);
    EXPECT_LT(worst, 0.25);
  }
}
} // namespace
