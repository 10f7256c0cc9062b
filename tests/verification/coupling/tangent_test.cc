#include "coupled_scene.h"

#include <coupling/membrane_body.h>

#include <gtest/gtest.h>

// The middle of a slack sheet is pressed on a heavy ball: one node, one spring,
// whose gain k T^2 / (4 m) is set. With the tangent of the contact in the
// implicit steps one pass is the trapezoidal rule, at any gain.
namespace
{
using coupling::ExchangeRule;

constexpr double stiffness = 1e6, sunk = 1e-4;

struct Swing
{
  double worst = 0.;        ///< off the closed form, over the amplitude [-]
  double growth = 0.;       ///< largest swing, late over early [-]
  double passes = 0.;       ///< per window [-]
  double energy_error = 0.; ///< work, see LedgerSums::work_residual [-]
};

struct Way
{
  ExchangeRule rule = ExchangeRule::one_pass;
  bool has_tangent = true;
  int particle_steps = 1;
  double damping = 0.;
};

fem::Membrane slack_sheet(double pressure)
{
  fem::MembraneParameters p;
  p.youngs_modulus = 1e-6;
  p.thickness = 1e-3;
  p.density = 1000.;
  fem::Membrane sheet(p, support::square_at(0.2, 0., 2));
  std::vector<std::int32_t> rim;
  for (std::int32_t k = 0; k < 9; ++k)
    if (k != 4)
      rim.push_back(k);
  sheet.tie(rim);
  sheet.set_pressure(pressure);
  return sheet;
}

Swing swing(double gain, const Way &way)
{
  dem::EngineParameters p = support::bare_parameters();
  p.surface.normal_stiffness = stiffness;
  p.surface.normal_damping = way.damping;
  p.particle.density = 1e15;
  dem::Engine engine(p);
  constexpr double radius = 0.5;
  support::add_sphere(engine, radius, {0., 0., 0.99 * sunk - radius});
  coupling::ExchangeParameters rules;
  rules.rule = way.rule;
  rules.has_contact_tangent = way.has_tangent;
  rules.particle_steps = way.particle_steps;
  rules.tolerance = 1e-13;
  rules.relaxation.factor = 1.;
  coupling::Exchange exchange(rules);
  // A quarter of four quads of 0.1 m hangs on the node.
  auto body = std::make_unique<coupling::MembraneBody>(
      slack_sheet(stiffness * sunk / 0.01), coupling::BodySteps{true, 1});
  const double mass = body->nodal_mass()[4];
  const coupling::MembraneBody &sheet = *body;
  exchange.add(std::move(body), sheet.membrane().mesh(), "sheet", p.surface,
               coupling::ParticleSide::inside, engine);
  const auto particles = coupling::particles_of(engine, support::no_shapes());
  const double window = 2. * std::sqrt(gain * mass / stiffness);
  for (int k = 0; k < 3; ++k) // the load that is there at the start
    exchange.advance(particles, 1e-6 * window);
  const int n = 600;
  double early = 0., late = 0.;
  Swing seen;
  for (int k = 1; k <= n; ++k)
  {
    exchange.advance(particles, window);
    const double z = sheet.membrane().positions()[4].z() + 0.01 * sunk;
    const double known =
        0.01 * sunk * std::cos(2. * std::atan(std::sqrt(gain)) * k);
    seen.worst = std::max(seen.worst, std::abs(z - known) / (0.01 * sunk));
    double &largest = k < n / 2 ? early : late;
    largest = std::max(largest, std::abs(z));
    if (!(std::abs(z) < sunk))
      return {1e9, 1e9, 0., 0.};
  }
  seen.growth = late / early;
  seen.passes = double(exchange.n_passes()) / double(exchange.n_windows());
  seen.energy_error = exchange.ledger().work_residual();
  return seen;
}
} // namespace

// x_(n+1) - x_n = T (v_n + v_(n+1)) / 2 and so on: phase 2 atan(sqrt(gain)) per
// window, nothing lost. Without the tangent one pass ends at a third.
TEST(ContactTangent, MakesOnePassTheTrapezoidalRule)
{
  for (const int n : {1, 10})
    for (const double gain : {0.1, 0.34, 1., 10.})
    {
      const Swing seen = swing(gain, {ExchangeRule::one_pass, true, n});
      EXPECT_LT(seen.worst, 1e-3) << gain << ", " << n;
      EXPECT_LT(seen.energy_error, 1e-11);
    }
  EXPECT_NEAR(swing(100., {ExchangeRule::one_pass, true, 10}).growth, 1., 1e-3);
  EXPECT_GT(swing(0.34, {ExchangeRule::one_pass, false}).growth, 1.5);
}

// Dashpots are half a step of the particles late: still nothing grows.
TEST(ContactTangent, BearsDashpots)
{
  for (const int n : {1, 10})
    for (const double gain : {0.1, 1., 10., 100.})
      EXPECT_LT(swing(gain, {ExchangeRule::one_pass, true, n, 0.3}).growth, 1.)
          << gain << ", " << n;
  EXPECT_GT(swing(1., {ExchangeRule::one_pass, false, 1, 0.3}).growth, 1e3);
}

// A spring needs no second pass, whatever its gain.
TEST(ContactTangent, LeavesNothingToRepeat)
{
  for (const double gain : {0.1, 1., 10.})
  {
    EXPECT_EQ(swing(gain, {ExchangeRule::iterated, true, 10}).passes, 1.);
    EXPECT_LT(swing(gain, {ExchangeRule::iterated, true, 10, 0.3}).passes, 1.5);
  }
  // Loads are rounded at 1e-12 of theirs, so that passes may end early.
  EXPECT_GT(swing(1., {ExchangeRule::iterated, false, 1}).passes, 2.);
}

TEST(ContactTangent, IsRefusedWhereThereAreNoWindows)
{
  coupling::ExchangeParameters rules;
  rules.has_contact_tangent = true;
  EXPECT_THROW(coupling::Exchange{rules}, std::invalid_argument);
}
