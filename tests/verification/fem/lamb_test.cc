#include "solid_scene.h"

#include <gtest/gtest.h>

// Lamb's problem: a vertical force that comes up smoothly on a small part of
// the surface of a half-space, and the settlement of a point beside it. P, S
// and Rayleigh wave arrive one after the other.
namespace
{
using Vector = Eigen::Vector3d;

// In units of the distance of the point, the shear wave speed and the density:
// G = 1, the shear wave arrives at t = 1.
const fem::SolidLayer ground{2.5, 0.25, 1.};
constexpr double rise = 0.5, disc = 0.25, duration = 1.8;

/// Settlement at distance 1 under a force that grows as t: the integral over
/// time of that under the force 1 from t = 0 on (Pekeris, PNAS 41 (1955) 469,
/// nu = 1/4).
double under_ramp(double t)
{
  const double root = std::sqrt(3.), p_wave = 1. / root;
  const double rayleigh = 0.5 * std::sqrt(3. + root); // 1.0877
  const double far = 0.5 * std::sqrt(3. - root);
  const double a = std::sqrt(3. * root + 5.), b = std::sqrt(3. * root - 5.);
  const auto before_s = [&](double s)
  {
    return 1. / 32. *
           (6. * s - root * std::acosh(2. * s) - a * std::asin(s / rayleigh) +
            b * std::acosh(s / far));
  };
  const auto before_rayleigh = [&](double s)
  { return 1. / 16. * (6. * s - a * std::asin(s / rayleigh)); };
  double sum = 0.;
  if (t > p_wave)
    sum += before_s(std::min(t, 1.)) - before_s(p_wave);
  if (t > 1.)
    sum += before_rayleigh(std::min(t, rayleigh)) - before_rayleigh(1.);
  if (t > rayleigh)
    sum += 3. / 8. * (t - rayleigh);
  return sum / M_PI;
}

/// The force: 1 in all, comes up in `rise` with the rate 2 sin^2 / rise.
double force(double t)
{
  const double share = std::clamp(t / rise, 0., 1.);
  return share - std::sin(2. * M_PI * share) / (2. * M_PI);
}

/// Spread over a disc as 3 (1 - s^2)^2 / pi, s over its radius.
double pressure(double s)
{
  return s < 1. ? 3. * std::pow(1. - s * s, 2) / (M_PI * disc * disc) : 0.;
}

/// Settlement at distance 1 from the middle of the disc; `n` points of the
/// integrals along its radius.
double exact(double t, int n = 16)
{
  const int n_around = 2 * n, n_times = 12 * n;
  double sum = 0.;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n_around; ++j)
    {
      const double s = (i + 0.5) / n, angle = M_PI * (j + 0.5) / n_around;
      const double away = std::hypot(1. - disc * s * std::cos(angle),
                                     disc * s * std::sin(angle));
      const double load = pressure(s) * 2. * M_PI * disc * disc * s / n;
      // What a ramp does, for the second derivative of the force.
      for (int k = 0; k < n_times; ++k)
      {
        const double then = rise * (k + 0.5) / n_times;
        const double bend =
            2. * M_PI / (rise * rise) * std::sin(2. * M_PI * then / rise);
        sum += load / n_around * bend * rise / n_times *
               under_ramp((t - then) / away);
      }
    }
  return sum;
}

/// Cells along a side of the inner square, their size beyond it and depth and
/// radius of the block.
struct Fineness
{
  int n = 8;
  double cell = 0.1, reach = 2.1;
};

std::vector<double> equal(double length, double cell)
{
  const auto n = std::size_t(std::lround(length / cell));
  return std::vector<double>(n, length / double(n));
}

fem::Solid half_space(const Fineness &fine)
{
  fem::QuarterCylinder block;
  block.n_square = fine.n;
  block.inner = equal(0.4, fine.cell);
  block.outer = equal(fine.reach - 1., fine.cell);
  block.heights = equal(fine.reach, fine.cell);
  fem::SolidParameters p;
  p.layers = {ground};
  fem::Solid solid(p, fem::quarter_cylinder_mesh(block));
  support::stand_in_a_half_space(solid);
  return solid;
}

/// Sums over time of found and exact settlement.
struct Misfit
{
  double square = 0., scale = 0., slope = 0., shift = 0.;

  void add(double found, double known, double rate)
  {
    square += std::pow(found - known, 2);
    scale += known * known;
    slope += rate * rate;
    shift -= rate * (found - known);
  }
  double share() const { return std::sqrt(square / scale); }
  double late() const { return shift / slope; } ///< by the best fit
};

struct Waves
{
  Misfit all, p_wave, rest; ///< rest: from the arrival of the S wave on
};

Waves waves(const Fineness &fine)
{
  fem::Solid solid = half_space(fine);
  const std::vector<Vector> loads = fem::traction_loads(
      solid.mesh(), fem::z_upper,
      [](const Vector &at)
      { return Vector(0., 0., -pressure(at.head<2>().norm() / disc)); },
      4);
  const auto station =
      std::size_t(support::node_at(solid.mesh(), {1., 0., 0.}));
  const double dt = 0.8 * solid.stable_time_step().time_step;
  std::vector<Vector> now(loads.size());
  double before = 0.;
  Waves seen;
  for (int k = 1; k * dt < duration; ++k)
  {
    solid.begin_step(dt);
    for (std::size_t i = 0; i < loads.size(); ++i)
      now[i] = force(k * dt) * loads[i];
    solid.end_step(now, dt);
    const double found = -solid.displacements()[station].z();
    const double known = exact(k * dt), rate = (known - before) / dt;
    before = known;
    seen.all.add(found, known, rate);
    (k * dt < 1. ? seen.p_wave : seen.rest).add(found, known, rate);
  }
  return seen;
}
} // namespace

TEST(Lamb, ClosedForm)
{
  const auto rate = [](double t)
  { return (under_ramp(t + 1e-7) - under_ramp(t - 1e-7)) / 2e-7; };
  EXPECT_EQ(under_ramp(0.577), 0.);
  EXPECT_NEAR(rate(0.57736), 0., 1e-4) << "the P wave begins smoothly";
  EXPECT_NEAR(rate(0.99999), rate(1.00001), 1e-4) << "S bends it";
  EXPECT_LT(rate(1.0876), -1.) << "the Rayleigh wave goes to infinity";
  EXPECT_NEAR(rate(2.), 0.75 / (2. * M_PI), 1e-8) << "(1 - nu) F / (2 pi G r)";
  for (const double t : {0.9, 1.2, 1.5})
    EXPECT_NEAR(exact(t), exact(t, 32), 1e-3 * exact(2.));
}

// Second order in the cells; 1 % of the modulus, the density or the force is
// more than the finest mesh may miss. Sides that absorb let the waves out.
TEST(Lamb, WavesArrive)
{
  const auto tell = [](const char *name, const Waves &seen)
  {
    std::printf("%s: misfit %.4f; P late by %.5f, S and Rayleigh by %.5f\n",
                name, seen.all.share(), seen.p_wave.late(), seen.rest.late());
    return seen;
  };
  const Waves coarse = tell("cells of 0.1", waves({8, 0.1}));
  const Waves middle = tell("cells of 0.05", waves({16, 0.05}));
  const Waves fine = tell("cells of 0.033", waves({24, 0.1 / 3.}));
  EXPECT_GT(coarse.all.share() / middle.all.share(), 4.);
  EXPECT_GT(middle.all.share() / fine.all.share(), 2.25);
  EXPECT_LT(fine.all.share(), 0.0115);
  EXPECT_LT(std::abs(fine.p_wave.late()), 1e-3);
  EXPECT_LT(std::abs(fine.rest.late()), 2.5e-3);
  const Waves near = tell("of 0.05, sides at 1.3", waves({16, 0.05, 1.3}));
  EXPECT_LT(near.all.share(), middle.all.share() + 0.005);
}
