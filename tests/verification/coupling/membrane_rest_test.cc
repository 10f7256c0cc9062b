#include "coupled_scene.h"

#include <coupling/membrane_body.h>
#include <dem/engine_boundaries.h>

#include <gtest/gtest.h>

// A sphere at rest on a square membrane under tension T: small deflections obey
// T lap w = -p.
namespace
{
constexpr double side = 0.4, tension = 500., radius = 0.01;

/// Deflection at (x, y) from a corner of a node load W at the middle, bilinear
/// elements: its modes are sines, with the eigenvalues of a mesh of n x n.
double discrete_deflection(double weight, int n, int column, int row)
{
  const double h = side / n;
  const auto stiffness = [&](int p) // of linear elements in one direction
  { return 2. * (1. - std::cos(M_PI * p / n)) / h; };
  const auto mass = [&](int p)
  { return h * (2. + std::cos(M_PI * p / n)) / 3.; };
  double sum = 0.;
  for (int p = 1; p < n; ++p)
    for (int q = 1; q < n; ++q)
      sum += std::sin(0.5 * M_PI * p) * std::sin(0.5 * M_PI * q) *
             std::sin(M_PI * p * column / n) * std::sin(M_PI * q * row / n) /
             (stiffness(p) * mass(q) + mass(p) * stiffness(q));
  return weight / tension * 4. / (n * n) * sum;
}

/// The same of the continuum, away from the load.
double deflection(double weight, double x, double y)
{
  double sum = 0.;
  for (int p = 1; p < 400; p += 2) // sum over q in closed form
  {
    const double k = M_PI * p / side;
    const double near = std::min(y, side - y);
    sum += std::sin(0.5 * M_PI * p) * std::sin(k * x) * std::sinh(k * near) /
           (2. * k * std::cosh(0.5 * k * side));
  }
  return weight / tension * 2. / side * sum;
}

struct Rest
{
  double centre = 0., quarter = 0.; ///< deflections [m]
  double weight = 0.;               ///< of the sphere [N]
  double particle = 0.;             ///< how far the sphere has come down [m]
  double overlap = 0.;              ///< of the contact [m]
};

Rest rest(int n, coupling::ExchangeRule rule)
{
  dem::EngineParameters p = support::bare_parameters();
  p.surface.normal_stiffness = 2e4;
  p.surface.normal_damping = 0.5;
  p.gravity = {0., 0., -0.1}; // small deflections
  p.local_damping = 0.3;
  dem::Engine engine(p);
  support::add_sphere(engine, radius, {0., 0., radius});
  fem::MembraneParameters m;
  m.tension = tension;
  m.youngs_modulus = 1e4; // no stiffness but of the tension
  m.density = 2000.;
  m.mass_damping = 200.;
  const fem::SurfaceMesh square = support::square_at(side, 0., n);
  fem::Membrane membrane(m, square);
  std::vector<std::int32_t> rim;
  for (std::size_t k = 0; k < square.nodes.size(); ++k)
    if (square.nodes[k].head<2>().cwiseAbs().maxCoeff() > 0.4999 * side)
      rim.push_back(static_cast<std::int32_t>(k));
  membrane.tie(rim);
  coupling::ExchangeParameters rules;
  rules.rule = rule;
  rules.tolerance = 1e-12;
  const bool is_explicit = rule == coupling::ExchangeRule::every_step;
  rules.particle_steps = is_explicit ? 1 : 20;
  coupling::Exchange exchange(rules);
  const coupling::BodySteps steps{!is_explicit, 1};
  coupling::DeformableBody &sheet = exchange.add(
      std::make_unique<coupling::MembraneBody>(std::move(membrane), steps),
      square, "membrane", p.surface, coupling::ParticleSide::outside, engine);
  const auto particles = coupling::particles_of(engine, support::no_shapes());
  const double step = 2e-5;
  const auto n_windows = std::lround(0.15 / (step * rules.particle_steps));
  for (long k = 0; k < n_windows; ++k)
    exchange.advance(particles, step * rules.particle_steps);
  const auto w = [&](int column, int row)
  {
    return -sheet.motion()
                .position[static_cast<std::size_t>(row * (n + 1) + column)]
                .z();
  };
  const std::size_t touch = support::only_nearest_point(dem::on_facets(engine));
  return {w(n / 2, n / 2), w(n / 4, n / 2), 0.1 * engine.particles().mass(0),
          radius - engine.particles().position(0).z(),
          dem::on_facets(engine).overlap.at(touch)};
}
} // namespace

TEST(SphereOnMembrane, RestsWhereTheMeshAndItsWeightSay)
{
  for (const auto rule :
       {coupling::ExchangeRule::every_step, coupling::ExchangeRule::iterated})
  {
    for (const int n : {8, 16})
    {
      if (n > 8 && rule == coupling::ExchangeRule::iterated)
        continue; // dear, and nothing new

      const Rest found = rest(n, rule);
      // Motion has died out to 1e-4.
      const double centre = discrete_deflection(found.weight, n, n / 2, n / 2);
      EXPECT_NEAR(found.centre, centre, 2e-3 * centre) << n;
      EXPECT_NEAR(found.overlap, found.weight / 2e4, 2e-3 * found.weight / 2e4);
      EXPECT_NEAR(found.particle, found.centre + found.overlap, 1e-3 * centre);
      const double quarter = discrete_deflection(found.weight, n, n / 4, n / 2);
      EXPECT_NEAR(found.quarter, quarter, 2e-3 * quarter) << n;
    }
  }
  // The mesh itself: second order away from the load.
  const double exact = deflection(1., 0.25 * side, 0.5 * side);
  const double coarse = discrete_deflection(1., 8, 2, 4) - exact,
               fine = discrete_deflection(1., 16, 4, 8) - exact,
               finest = discrete_deflection(1., 32, 8, 16) - exact;
  std::printf("w at a quarter: exact %.6e, errors %.2e %.2e %.2e\n", exact,
              coarse, fine, finest);
  EXPECT_NEAR(fine / finest, 4., 0.5);
}
