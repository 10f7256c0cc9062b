#include "coupled_scene.h"
#include "solid_scene.h"

#include <coupling/solid_body.h>
#include <dem/engine_boundaries.h>

#include <gtest/gtest.h>

#include <complex>

// Particles on elastic bodies: a block on four balls, a chain of spheres
// against a bar, and the three ways to move a body beside each other.
namespace
{
constexpr double block_side = 0.1, ball = 0.01, spring = 2450., gravity = 9.81;

/// The block of MercuryDPM's case: 2 x 2 x 2 cells of 1 MPa, 1000 kg/m^3.
fem::Solid block()
{
  fem::SolidParameters p;
  p.layers = {{1e6, 0.3, 1000.}};
  return {p, support::box(dem::Vec3::Constant(block_side), {2, 2, 2})};
}

struct Swing
{
  double lowest = 0., highest = 0., last = 0.; ///< overlaps [m]
  double residual = 0.;                        ///< of the ledger [-]
};

/// Balls that nothing moves under a block that falls by `damping`.
Swing on_balls(const coupling::ExchangeParameters &rules,
               const coupling::BodySteps &steps, double damping,
               double duration)
{
  dem::EngineParameters p = support::bare_parameters();
  p.surface.normal_stiffness = spring;
  p.surface.normal_damping = damping;
  p.particle.density = 1e9;
  dem::Engine engine(p);
  for (const double x : {0.025, 0.075})
    for (const double y : {0.025, 0.075})
      support::add_sphere(engine, ball, {x, y, -ball});
  coupling::Exchange exchange(rules);
  auto body =
      std::make_unique<coupling::SolidBody>(block(), fem::z_lower, steps);
  const fem::SurfaceMesh mesh = body->mesh();
  coupling::SolidBody *kept = body.get();
  coupling::Field weight(kept->solid().mesh().nodes.size());
  for (std::size_t k = 0; k < weight.size(); ++k)
    weight[k] = -gravity * kept->solid().nodal_mass()[k] * dem::Vec3::UnitZ();
  kept->set_dead_load(weight);
  exchange.add(std::move(body), mesh, "block", p.surface,
               coupling::ParticleSide::outside, engine);
  const auto particles = coupling::particles_of(engine, support::no_shapes());
  const double window = 1e-4 * rules.particle_steps;
  Swing swing;
  for (int k = 0; k * window < duration; ++k)
  {
    exchange.advance(particles, window);
    double mean = 0.;
    const dem::ContactBatch &batch = dem::on_facets(engine);
    for (std::size_t c = 0; c < batch.size(); ++c)
      mean += 0.25 * batch.overlap[c];
    swing.lowest = k == 0 ? mean : std::min(swing.lowest, mean);
    swing.highest = std::max(swing.highest, mean);
    swing.last = mean;
  }
  swing.residual = exchange.ledger().work_residual();
  return swing;
}

coupling::ExchangeParameters rules_of(coupling::ExchangeRule rule,
                                      int particle_steps = 1)
{
  coupling::ExchangeParameters rules;
  rules.rule = rule;
  rules.particle_steps = particle_steps;
  rules.tolerance = 1e-11;
  return rules;
}
} // namespace

// Static overlap M g / (4 k) = 1.001 mm; without damping it swings between
// nothing and twice that, and the block's own softness, 1 / 20 of the springs,
// takes part with a few per cent.
TEST(BlockOnBalls, SwingsAboutItsRest)
{
  using coupling::ExchangeRule;
  const double sunk = 1000. * std::pow(block_side, 3) * gravity / (4. * spring);
  EXPECT_NEAR(sunk, 1.001e-3, 1e-6);
  const struct
  {
    coupling::ExchangeParameters rules;
    coupling::BodySteps steps;
  } ways[] = {{rules_of(ExchangeRule::every_step), {}},
              {rules_of(ExchangeRule::one_pass, 2), {false, 1}},
              {rules_of(ExchangeRule::iterated, 5), {true, 1}},
              {rules_of(ExchangeRule::iterated, 5), {false, 4}}};
  for (const auto &way : ways)
  {
    const Swing free = on_balls(way.rules, way.steps, 0., 0.2);
    EXPECT_NEAR(free.highest, 2. * sunk, 0.08 * sunk);
    EXPECT_LT(free.lowest, 0.08 * sunk);
    EXPECT_LT(free.residual, 1e-2);
    const Swing damped = on_balls(way.rules, way.steps, 0.5, 0.5);
    EXPECT_NEAR(damped.last, sunk, 2e-3 * sunk);
  }
}

namespace
{
/// A chain of spheres pressed against the end of a bar, along x.
struct Chain
{
  static constexpr int n_spheres = 60, n_cells = 200;
  static constexpr double radius = 0.01, pressed = 50.;
  double bar_modulus = 1e9, bar_density = 2000.;
  double wall_spring = 1e6; ///< of the last sphere on the bar [N/m]
};

/// Share of the energy of a wave packet that comes back from the bar.
struct Reflection
{
  double found = 0., expected = 0.;
  double ledger = 0.;
};

Reflection reflect(const Chain &chain, double phase)
{
  dem::EngineParameters p = support::bare_parameters();
  p.surface.normal_stiffness = chain.wall_spring;
  p.wall.normal_stiffness = 1e8;
  dem::Engine engine(p);
  const double r = Chain::radius;
  // Hertz, equal spheres: F = 4/3 E* sqrt(r / 2) delta^(3/2).
  const double modulus =
      p.particle.shear_modulus / (1. - p.particle.poisson_ratio);
  const double overlap =
      std::pow(0.75 * Chain::pressed / (modulus * std::sqrt(0.5 * r)), 2. / 3.);
  const double pitch = 2. * r - overlap;
  const double stiffness = 1.5 * Chain::pressed / overlap;
  const double last = -r + Chain::pressed / chain.wall_spring;
  for (int i = 0; i < Chain::n_spheres; ++i)
    support::add_sphere(engine, r, {last - pitch * i, 0., 0.});
  const double mass = engine.particles().mass(0);
  const double frequency =
      2. * std::sqrt(stiffness / mass) * std::sin(0.5 * phase);
  // A plane holds the other end.
  const double far = last - pitch * (Chain::n_spheres - 1);
  dem::add_plane(engine,
                 {far - r + Chain::pressed / p.wall.normal_stiffness, 0., 0.},
                 dem::Vec3::UnitX());

  // The bar: nu = 0, cross-section as the spheres are wide.
  const double width = 2. * r, cell = 0.5 * width;
  fem::SolidParameters solid;
  solid.layers = {{chain.bar_modulus, 0., chain.bar_density}};
  fem::SolidMesh mesh = support::box({cell * Chain::n_cells, width, width},
                                     {Chain::n_cells, 1, 1});
  for (dem::Vec3 &node : mesh.nodes)
    node -= dem::Vec3(0., 0.5 * width, 0.5 * width);
  fem::Solid bar(solid, mesh);
  bar.fix(fem::x_upper, {true, true, true});
  coupling::Field load(mesh.nodes.size(), dem::Vec3::Zero());
  for (std::size_t k = 0; k < load.size(); ++k)
    if (mesh.nodes[k].x() < 0.1 * cell)
      load[k].x() = 0.25 * Chain::pressed;
  bar.settle(load);
  const double shortened = bar.displacements()[0].x();
  for (std::size_t i = 0; i < engine.particles().size(); ++i)
    engine.particles().position(i).x() += shortened;
  dem::planes(engine)[0].point.x() += shortened;
  coupling::Exchange exchange(rules_of(coupling::ExchangeRule::every_step));
  auto body = std::make_unique<coupling::SolidBody>(
      std::move(bar), fem::x_lower, coupling::BodySteps{});
  const fem::SurfaceMesh end = body->mesh();
  exchange.add(std::move(body), end, "bar", p.surface,
               coupling::ParticleSide::outside, engine);

  // A packet on its way to the bar, velocities and displacements.
  const double centre = 0.5 * Chain::n_spheres, breadth = 7.;
  const double speed = 1e-4;
  const auto wave = [&](double i) // i grows away from the bar
  {
    const double gauss = std::exp(-0.5 * std::pow((i - centre) / breadth, 2));
    return std::complex<double>(std::cos(phase * i), std::sin(phase * i)) *
           gauss;
  };
  for (int i = 0; i < Chain::n_spheres; ++i)
  {
    // v = Re(a e^{i(q n + w t)}): towards n = 0; x = Re(a e^{..} / (i w)).
    const std::complex<double> a = wave(i);
    engine.particles().velocity(std::size_t(i)).x() = speed * a.real();
    engine.particles().position(std::size_t(i)).x() +=
        speed * a.imag() / frequency;
  }
  const auto kinetic = [&]
  {
    double sum = 0.;
    for (int i = 0; i < Chain::n_spheres; ++i)
      sum += engine.particles().kinetic_energy(std::size_t(i));
    return sum;
  };
  // There and back again: the packet is in the middle of the chain.
  const double group = std::sqrt(stiffness / mass) * std::cos(0.5 * phase);
  const double duration = 2. * centre / group;
  const double fastest = std::sqrt(chain.bar_modulus / chain.bar_density);
  const double step = std::min(0.05 * std::sqrt(mass / stiffness),
                               0.4 * cell / fastest / std::sqrt(3.));
  const auto particles = coupling::particles_of(engine, support::no_shapes());
  // Half of the energy is kinetic, on average over a period.
  const double period = 2. * M_PI / frequency;
  const auto mean_of = [&](double time)
  {
    double sum = 0.;
    const auto n = std::lround(time / step);
    for (long k = 0; k < n; ++k)
    {
      exchange.advance(particles, step);
      sum += kinetic();
    }
    return sum / double(n);
  };
  const double before = mean_of(period);
  mean_of(duration - 2. * period);
  const double after = mean_of(period);

  // k_c joins sphere 0 to the impedance Z of the bar.
  const std::complex<double> i(0., 1.);
  const double impedance =
      width * width * std::sqrt(chain.bar_modulus * chain.bar_density);
  const std::complex<double> coupled =
      chain.wall_spring * (i * frequency * impedance) /
      (chain.wall_spring + i * frequency * impedance);
  // -m w^2 u_0 = k (u_1 - u_0) - coupled u_0, u_n = e^{iqn} + R e^{-iqn}.
  const auto balance = [&](double q)
  {
    return mass * frequency * frequency + stiffness * (std::exp(i * q) - 1.) -
           coupled;
  };
  const double share = std::norm(balance(phase) / balance(-phase));
  return {after / before, share, exchange.ledger().work_residual()};
}
} // namespace

// The last sphere with its contact against the impedance of the bar: the share
// of energy that comes back, from soft to stiff bars.
TEST(ChainOnBar, ReflectsByTheImpedances)
{
  for (const double density : {200., 2000., 20000.})
  {
    Chain chain;
    chain.bar_density = density;
    chain.bar_modulus = 5e5 * density; // c = 707 m/s: no echo in time
    const Reflection energy = reflect(chain, 0.9);
    std::printf("bar of %6.0f kg/m^3: energy back %.4f, expected %.4f\n",
                density, energy.found, energy.expected);
    // A packet is as wide as 7 spheres: its spectrum smears R.
    EXPECT_NEAR(energy.found, energy.expected, 0.03);
    EXPECT_LT(energy.ledger, 1e-9);
  }
}

// Explicit, implicit and condensed with all inner modes: one body.
TEST(Bodies, ThreeWaysOneBody)
{
  using coupling::ExchangeRule;
  const auto sink = [](int way, double window)
  {
    dem::EngineParameters p = support::bare_parameters();
    p.surface.normal_stiffness = 1e5;
    p.gravity = {0., 0., -gravity};
    dem::Engine engine(p);
    support::add_sphere(engine, 0.02, {0.05, 0.04, block_side + 0.02});
    engine.particles().velocity(0).z() = -0.2;
    fem::SolidParameters solid;
    solid.layers = {{2e6, 0.3, 1500.}};
    fem::Solid body(solid,
                    support::box(dem::Vec3::Constant(block_side), {2, 2, 2}));
    body.fix(fem::z_lower, {true, true, true});
    coupling::ExchangeParameters rules = rules_of(ExchangeRule::iterated);
    rules.particle_steps = std::max(1, int(std::lround(window / 5e-6)));
    coupling::Exchange exchange(rules);
    std::unique_ptr<coupling::DeformableBody> moved;
    fem::SurfaceMesh mesh;
    if (way == 2)
    {
      auto one = std::make_unique<coupling::CondensedBody>(body, fem::z_upper,
                                                           27, 1, window);
      mesh = one->mesh();
      moved = std::move(one);
    }
    else
    {
      auto one = std::make_unique<coupling::SolidBody>(
          std::move(body), fem::z_upper,
          coupling::BodySteps{way == 1, way == 1 ? 1 : 2});
      mesh = one->mesh();
      moved = std::move(one);
    }
    coupling::DeformableBody &kept =
        exchange.add(std::move(moved), mesh, "top", p.surface,
                     coupling::ParticleSide::outside, engine);
    const double start = support::residual(engine, {&kept});
    const auto particles = coupling::particles_of(engine, support::no_shapes());
    for (int k = 0; k < std::lround(4e-3 / window); ++k)
      exchange.advance(particles, window);
    EXPECT_NEAR(support::residual(engine, {&kept}), start,
                2e-3 * exchange.ledger().moved)
        << way;
    EXPECT_LT(exchange.ledger().work_residual(), 1e-5) << way;
    return engine.particles().position(0).z();
  };
  const double exact = sink(1, 5e-6);
  const double reach = 0.12 - exact;
  EXPECT_GT(reach, 1e-4);
  for (int way = 0; way < 3; ++way)
    EXPECT_NEAR(sink(way, 2e-5), exact, 2e-4 * reach) << way;
  // The condensed body with all its modes is the implicit one.
  EXPECT_NEAR(sink(2, 2e-5), sink(1, 2e-5), 1e-9 * reach);
}
