#include "coupled_scene.h"

#include <coupling/membrane_body.h>
#include <dem/engine_boundaries.h>

#include <gtest/gtest.h>

#include <cstring>
#include <shape/test_shapes.h>

// Windows: what they leave is what one straight pass leaves, bit for bit; sums
// of work and momentum close.
namespace
{
using coupling::ExchangeRule;

/// A particle of its own shape falls on a membrane whose rim is tied; another
/// lies under a plate.
struct Scene
{
  dem::Engine engine;
  coupling::Exchange exchange;
  coupling::ShapeLibrary shapes;
  coupling::DeformableBody *sheet = nullptr, *plate = nullptr;

  static dem::EngineParameters parameters(double fracture_energy)
  {
    dem::EngineParameters p; // frictional, damped, breakable
    p.surface.normal_stiffness = 2e4;
    p.surface.shear_stiffness = 1.7e4;
    p.surface.friction = 0.4;
    p.geometry.wall_geometry = dem::ContactGeometry::radial;
    p.breakage.fracture_energy = fracture_energy;
    p.gravity = {0., 0., -9.81};
    return p;
  }

  Scene(const coupling::ExchangeParameters &rules, double fracture_energy,
        const coupling::BodySteps &steps = {})
      : engine(parameters(fracture_energy)), exchange(rules)
  {
    shapes = {std::make_shared<const dem::Coefficients>(
        dem::test::random_particle(12, 3))};
    for (int k = 0; k < 3; ++k)
    {
      engine.add_particle(dem::make_shape(shapes[0], 0.01),
                          {0.004 * k - 0.004, 0.002 * k, 0.014 + 0.026 * k},
                          dem::Quaternion::Identity());
      engine.particles().velocity(std::size_t(k)) = {0.1, 0., -1.};
    }
    fem::MembraneParameters m;
    m.tension = 300.;
    m.density = 4000.;
    const fem::SurfaceMesh square = support::square_at(0.1, 0., 6);
    fem::Membrane membrane(m, square);
    std::vector<std::int32_t> rim;
    for (std::size_t k = 0; k < square.nodes.size(); ++k)
      if (square.nodes[k].head<2>().cwiseAbs().maxCoeff() > 0.0499)
        rim.push_back(static_cast<std::int32_t>(k));
    membrane.tie(rim);
    sheet = &exchange.add(
        std::make_unique<coupling::MembraneBody>(std::move(membrane), steps),
        square, "membrane", engine.parameters().surface,
        coupling::ParticleSide::outside, engine);
    const fem::SurfaceMesh above = support::square_at(0.06, 0.08);
    coupling::RigidDrive drive;
    drive.load = [](double)
    {
      fem::PlateLoad load;
      load.force.z() = -20.;
      return load;
    };
    plate = &exchange.add(std::make_unique<coupling::RigidBody>(
                              support::upright(0.5), above.nodes, drive),
                          above, "plate", engine.parameters().surface,
                          coupling::ParticleSide::inside, engine);
  }

  void advance(double window, int n)
  {
    const coupling::CoupledParticles particles =
        coupling::particles_of(engine, shapes);
    for (int k = 0; k < n; ++k)
      exchange.advance(particles, window);
  }
  std::string state() const
  {
    std::ostringstream out(std::ios::binary);
    engine.save(out, shapes);
    exchange.save(out);
    return out.str();
  }
  void restore(const std::string &from)
  {
    std::istringstream in(from, std::ios::binary);
    engine.restore(in, shapes);
    exchange.restore(in);
  }
};

coupling::ExchangeParameters rules_of(ExchangeRule rule, int particle_steps = 1,
                                      double tolerance = 1e-11)
{
  coupling::ExchangeParameters rules;
  rules.rule = rule;
  rules.particle_steps = particle_steps;
  rules.tolerance = tolerance;
  rules.ledger_limit = std::numeric_limits<double>::infinity();
  return rules;
}

constexpr double particle_step = 2e-6;
constexpr double brittle = 1., tough = 1e9; // J/m^2
} // namespace

// A saved scene goes on as if it had not been saved, in every way of exchange.
TEST(Windows, ContinueBitForBit)
{
  for (const ExchangeRule rule :
       {ExchangeRule::every_step, ExchangeRule::one_pass,
        ExchangeRule::iterated})
  {
    const int n = rule == ExchangeRule::every_step ? 1 : 4;
    const auto rules = rules_of(rule, n);
    Scene unbroken(rules, brittle);
    unbroken.advance(n * particle_step, 2400 / n);
    const std::string middle = unbroken.state();
    unbroken.advance(n * particle_step, 1200 / n);
    Scene resumed(rules, brittle);
    resumed.restore(middle);
    EXPECT_EQ(resumed.state(), middle);
    resumed.advance(n * particle_step, 1200 / n);
    EXPECT_EQ(resumed.state(), unbroken.state()) << int(rule);
    EXPECT_GT(unbroken.engine.n_events(), 0);
    EXPECT_LT(std::size_t(0),
              dem::facet_boundary(unbroken.engine, 0).near.particle.size());
  }
}

// What an iterated window leaves of the particles is what a single pass along
// its last motion leaves: contact history, cumulative factors, shapes,
// velocities.
TEST(Windows, IterationLeavesNoTraceOfItsPasses)
{
  const int n = 4;
  Scene scene(rules_of(ExchangeRule::iterated, n), brittle);
  scene.advance(n * particle_step, 500);
  int n_breaking = 0, n_repeated = 0;
  for (int k = 0; k < 300; ++k)
  {
    std::ostringstream before(std::ios::binary), after(std::ios::binary);
    scene.engine.save(before, scene.shapes);
    std::vector<coupling::Field> from, to;
    const std::array<std::size_t, 2> n_nodes{49, 4};
    const auto nodes = [&](std::vector<coupling::Field> &where)
    {
      for (std::size_t s = 0; s < 2; ++s)
      {
        const auto &position = dem::surface(scene.engine, s).position;
        where.emplace_back(position.begin(),
                           position.begin() + std::ptrdiff_t(n_nodes[s]));
      }
    };
    nodes(from);
    scene.advance(n * particle_step, 1);
    nodes(to);
    scene.engine.save(after, scene.shapes);
    n_repeated += scene.exchange.last_window().passes > 1;

    dem::Engine once(Scene::parameters(brittle));
    std::istringstream in(before.str(), std::ios::binary);
    once.restore(in, scene.shapes);
    const std::int64_t events_before = once.n_events();
    const double window = n * particle_step;
    for (std::size_t s = 0; s < 2; ++s)
      for (dem::Vec3 &impulse : dem::facet_boundary(once, s).impulse)
        impulse = dem::Vec3::Zero();
    for (int step = 1; step <= n; ++step)
    {
      for (std::size_t s = 0; s < 2; ++s)
      {
        coupling::Field velocity(from[s].size()), position = to[s];
        for (std::size_t v = 0; v < velocity.size(); ++v)
        {
          velocity[v] = (to[s][v] - from[s][v]) / window;
          if (step < n)
            position[v] -= window * (n - step) / n * velocity[v];
        }
        const fem::SurfaceMesh mesh = s == 0 ? support::square_at(0.1, 0., 6)
                                             : support::square_at(0.06, 0.08);
        coupling::InterfaceMap(mesh).send_motion({position, velocity},
                                                 dem::surface(once, s));
      }
      once.advance(window / n);
    }
    std::ostringstream plain(std::ios::binary);
    once.save(plain, scene.shapes);
    ASSERT_EQ(plain.str(), after.str()) << "window " << k;
    n_breaking += once.n_events() > events_before;
  }
  EXPECT_GT(n_breaking, 0);
  EXPECT_GT(n_repeated, 100);
  // Events of passes that were undone are not told.
  const auto told =
      scene.exchange.take_events().size() + scene.engine.take_events().size();
  EXPECT_EQ(std::int64_t(told), scene.engine.n_events());
}

// Nor are those of windows that have been undone.
TEST(Windows, RestoringTakesEventsBack)
{
  const int n = 4;
  Scene scene(rules_of(ExchangeRule::iterated, n), brittle);
  scene.advance(n * particle_step, 500);
  const auto told = [&scene]
  {
    return scene.exchange.take_events().size() +
           scene.engine.take_events().size();
  };
  told();
  const std::int64_t n_before = scene.engine.n_events();
  const std::string middle = scene.state();
  scene.advance(n * particle_step, 300);
  const std::int64_t n_after = scene.engine.n_events();
  ASSERT_GT(n_after, n_before);
  scene.restore(middle);
  scene.advance(n * particle_step, 300);
  EXPECT_EQ(std::int64_t(told()), n_after - n_before);
}

// Work that the particles gave and the bodies took: to round-off with every
// step, to the tolerance when iterated; one pass stays small where it is
// stable. Impulses agree to round-off always. Friction and dashpots are there.
TEST(Windows, LedgerCloses)
{
  const auto ledger = [](ExchangeRule rule, int particle_steps)
  {
    Scene scene(rules_of(rule, particle_steps), tough);
    scene.advance(particle_steps * particle_step, 4000 / particle_steps);
    EXPECT_GT(scene.exchange.ledger().moved, 1e-3);
    EXPECT_LT(scene.exchange.ledger().impulse_residual(), 1e-12);
    return scene.exchange.ledger().work_residual();
  };
  EXPECT_LT(ledger(ExchangeRule::every_step, 1), 1e-12);
  for (const int n : {1, 10, 100})
    // Long windows end at jumps of contact forces now and then.
    EXPECT_LT(ledger(ExchangeRule::iterated, n), n < 100 ? 1e-5 : 2e-4) << n;
  std::vector<double> error;
  for (const int n : {8, 4, 2, 1})
    error.push_back(ledger(ExchangeRule::one_pass, n));
  std::printf("ledger of one pass: %.3e %.3e %.3e %.3e\n", error[0], error[1],
              error[2], error[3]);
  EXPECT_LT(error[0], 1e-3);
  EXPECT_LT(error[3], 1e-4);
}

// Free plate, particles between: nothing but gravity and the drive, the tied
// rim and what they give is known. Momentum of particles and plate with the
// loads.
TEST(Windows, MomentumOfParticlesIsWhatTheBodiesGot)
{
  for (const ExchangeRule rule :
       {ExchangeRule::every_step, ExchangeRule::one_pass,
        ExchangeRule::iterated})
  {
    const int n = rule == ExchangeRule::every_step ? 1 : 5;
    Scene scene(rules_of(rule, n), tough);
    const dem::Vec3 start = support::momentum(scene.engine);
    scene.advance(n * particle_step, 3000 / n);
    const double mass = 3. * scene.engine.particles().mass(0);
    const dem::Vec3 fallen =
        mass * scene.engine.time() * dem::Vec3(0., 0., -9.81);
    const dem::Vec3 missing = start + fallen - support::momentum(scene.engine) -
                              scene.exchange.ledger().impulse_taken;
    // Thousands of sums, each rounded.
    EXPECT_LT(missing.norm(), 1e-10 * scene.exchange.ledger().impulse_moved)
        << int(rule);
    EXPECT_GT(scene.exchange.ledger().impulse_moved, 1e-3);
  }
}

// The energy of the whole scene: one law for particles, contacts and bodies.
TEST(Windows, EnergyOfTheWholeCloses)
{
  const auto missing = [](ExchangeRule rule, int particle_steps, int body_steps,
                          bool is_implicit)
  {
    Scene scene(rules_of(rule, particle_steps), tough,
                {is_implicit, body_steps});
    const auto residual = [&scene] {
      return support::residual(scene.engine, {scene.sheet, scene.plate});
    };
    const double start = residual(); // the particles have come with a speed
    scene.advance(particle_steps * particle_step, 4000 / particle_steps);
    return std::abs(residual() - start) / scene.exchange.ledger().moved;
  };
  EXPECT_LT(missing(ExchangeRule::every_step, 1, 1, false), 2e-3);
  EXPECT_LT(missing(ExchangeRule::iterated, 1, 4, false), 2e-3);
  EXPECT_LT(missing(ExchangeRule::iterated, 4, 1, true), 2e-3);
  EXPECT_LT(missing(ExchangeRule::one_pass, 4, 1, false), 1e-2);
}

TEST(Windows, LedgerLimitStopsTheRun)
{
  auto rules = rules_of(ExchangeRule::one_pass, 8);
  rules.ledger_limit = 1e-9;
  Scene scene(rules, tough);
  EXPECT_THROW(scene.advance(8 * particle_step, 500), std::runtime_error);
}

TEST(Windows, WhatMakesNoSenseIsRefused)
{
  EXPECT_THROW(coupling::Exchange(rules_of(ExchangeRule::every_step, 2)),
               std::invalid_argument);
  EXPECT_THROW(Scene(rules_of(ExchangeRule::every_step), tough, {true, 1}),
               std::invalid_argument);
  EXPECT_THROW(Scene(rules_of(ExchangeRule::every_step), tough, {false, 2}),
               std::invalid_argument);
}
