#include "dem_scene.h"

#include <dem/engine_boundaries.h>
#include <dem/integrate/time_step.h>
#include <dem/measure/contact_springs.h>

#include <gtest/gtest.h>

#include <limits>
#include <random>
#include <shape/test_shapes.h>
#include <stdexcept>

// The step that the contacts of a scene allow is where the engine itself
// becomes unstable: a small disturbance stays small 0.3 % below it and grows
// without bound 0.3 % above. A spring or mass that is 1 % wrong moves the step
// by 0.5 % and is caught.
namespace
{
using dem::Vec3;

constexpr double below = 0.997, above = 1.003;
/// Without damping a disturbance beats, up to 1 / sqrt(2 x 0.003) = 13 times
/// (and a little, since the modes of several particles mix).
/// Growth ends where k_s varies so much within a step that the loss of the
/// shear springs takes up what the step makes.
constexpr double bounded = 40., unbounded = 500.;

/// Kinetic speeds of the scene: largest |v| + r |omega| [m/s].
double fastest(const dem::Engine &engine)
{
  double speed = 0.;
  const dem::ParticleSystem &particles = engine.particles();
  for (std::size_t i = 0; i < particles.size(); ++i)
    speed = std::max(speed, particles.velocity(i).norm() +
                                particles.radius(i) * particles.spin(i).norm());
  return speed;
}

/// Largest speed of a later hundred steps over that of the first ten, after a
/// disturbance of all particles at rest, up to `along` [m/s]; infinite where
/// the engine stops since they leap.
double growth(dem::Engine &engine, double dt, int n_steps,
              const Vec3 &along = Vec3::Constant(1e-9))
{
  std::mt19937 generator(1);
  std::uniform_real_distribution<double> share(-1., 1.);
  dem::ParticleSystem &particles = engine.particles();
  for (std::size_t i = 0; i < particles.size(); ++i)
    for (int d = 0; d < 3; ++d)
    {
      particles.velocity(i)[d] = along[d] * share(generator);
      particles.spin(i)[d] = along[d] * share(generator) / particles.radius(i);
    }
  const auto largest = [&](int n)
  {
    double speed = 0.;
    for (int step = 0; step < n; ++step)
    {
      engine.advance(dt);
      speed = std::max(speed, fastest(engine));
    }
    return speed;
  };
  const double early = largest(10);
  try
  {
    support::advance(engine, dt, n_steps);
    return largest(100) / early;
  }
  catch (const std::runtime_error &)
  {
    return std::numeric_limits<double>::infinity();
  }
}

dem::EngineParameters frictional()
{
  dem::EngineParameters p = support::bare_parameters();
  p.wall.normal_stiffness = 1e8;
  p.wall.shear_stiffness = 0.85e8;
  p.wall.friction = p.particle.friction = 1e6;
  return p;
}

constexpr double radius = 0.01;

/// A ball that its weight presses into the corner of three walls.
dem::Engine corner_ball(dem::EngineParameters parameters)
{
  parameters.gravity = Vec3::Constant(-1e4);
  dem::Engine engine(parameters);
  for (int d = 0; d < 3; ++d)
    dem::add_plane(engine, Vec3::Zero(), Vec3::Unit(d));
  support::add_sphere(engine, radius, Vec3::Constant(radius));
  const double mass = engine.particles().mass(0);
  engine.particles().position(0) -=
      Vec3::Constant(mass * 1e4 / parameters.wall.normal_stiffness);
  // The contacts are found; nothing moves.
  engine.particles().load[0].force = -mass * parameters.gravity;
  engine.advance(1e-15);
  engine.come_to_rest();
  return engine;
}

/// Largest eigenvalue m lambda of [k_n + 2 k_s, sqrt(3) k_s; ., 2 (k_s + q)]
/// over m, 2/5 m, with dt^2 k + 2 dt c for every k: displacement across
/// (1, 1, 1) and the turning that belongs to it. `lever` over the radius [-].
double corner_eigenvalue(const dem::WallMaterial &wall, double mass,
                         double lever, double dt)
{
  const auto spring = [&](double k, double beta)
  { return dt * dt * k + 4. * dt * beta * std::sqrt(k * mass); };
  const double normal = spring(wall.normal_stiffness, wall.normal_damping),
               shear = spring(wall.shear_stiffness, wall.shear_damping);
  const double rolling =
      wall.rolling_friction > 0. ? dt * dt * wall.shear_stiffness : 0.;
  const double a = normal + 2. * shear,
               d = 5. * lever * lever * (shear + rolling),
               off = std::sqrt(3. / 0.4) * lever * shear;
  return (0.5 * (a + d) + std::sqrt(0.25 * (a - d) * (a - d) + off * off)) /
         mass;
}
} // namespace

TEST(EngineNetworkStep, BallInACorner)
{
  for (const double rolling : {0., 1e6})
    for (const double beta : {0., 0.3, 0.62})
      for (const double local : {0., 0.5})
      {
        dem::EngineParameters p = frictional();
        p.wall.normal_damping = p.wall.shear_damping = beta;
        p.wall.rolling_friction = rolling;
        p.local_damping = local;
        dem::Engine scene = corner_ball(p);
        const dem::SpringNetwork network = dem::contact_springs(scene, 0.);
        ASSERT_EQ(network.n_contacts(), 3u);
        const double step = dem::guaranteed_step(network).step;
        // The lever is the distance of the walls.
        const double lever = scene.particles().position(0).x() / radius;
        EXPECT_NEAR(
            corner_eigenvalue(p.wall, scene.particles().mass(0), lever, step),
            4., 1e-6);
        EXPECT_NEAR(dem::sharp_step(network), step, 1e-6 * step);
        // That of a ball that only touches; here the overlap is 1e-4 of it.
        EXPECT_NEAR(dem::corner_step(p, scene.particles()), step, 2e-4 * step);
        // One wall alone would allow far more.
        EXPECT_LT(step, 0.75 * dem::critical_step(p, scene.particles()).step);
        EXPECT_LT(growth(scene, below * step, 2000), bounded);
        if (local > 0.)
          continue; // may brake what would grow
        dem::Engine again = corner_ball(p);
        EXPECT_GT(growth(again, above * step, 2000), unbounded);
      }
}

// omega = 2 sqrt(k/m) cos(pi / (2 (n + 1))): balls in a row between two walls
// as stiff as the balls are to each other.
TEST(EngineNetworkStep, ChainBetweenWalls)
{
  constexpr int n = 6;
  constexpr double overlap = 1e-5;
  dem::EngineParameters p = support::bare_parameters();
  const double modulus = p.particle.shear_modulus /
                         (1. - p.particle.poisson_ratio); // E*, equal bodies
  const double k = 2. * modulus * std::sqrt(0.5 * radius * overlap);
  p.wall.normal_stiffness = k;
  const double wall_overlap = 2. / 3. * overlap; // F = 2/3 k delta
  const auto make = [&]
  {
    dem::Engine engine(p);
    for (int i = 0; i < n; ++i)
      support::add_sphere(
          engine, radius,
          {radius - wall_overlap + i * (2. * radius - overlap), 0., 0.});
    const double end =
        engine.particles().last().position.x() + radius - wall_overlap;
    dem::add_plane(engine, Vec3::Zero(), Vec3::UnitX());
    dem::add_plane(engine, end * Vec3::UnitX(), -Vec3::UnitX());
    engine.advance(1e-15);
    engine.come_to_rest();
    return engine;
  };
  dem::Engine engine = make();
  const dem::SpringNetwork network = dem::contact_springs(engine, 0.);
  ASSERT_EQ(network.n_contacts(), static_cast<std::size_t>(n + 1));
  const double mass = engine.particles().mass(0);
  const double exact =
      std::sqrt(mass / k) / std::cos(0.5 * std::numbers::pi / (n + 1));
  const double step = dem::sharp_step(network);
  EXPECT_NEAR(step, exact, 1e-7 * exact);
  // The bound is not below the limit of long chains.
  const double bound = dem::guaranteed_step(network).step;
  EXPECT_LE(bound, step);
  EXPECT_GE(bound, std::sqrt(mass / k) * (1. - 1e-7));
  // A row under pressure buckles: disturbed along its axis only.
  EXPECT_LT(growth(engine, below * step, 2000, 1e-9 * Vec3::UnitX()), bounded);
  dem::Engine again = make();
  EXPECT_GT(growth(again, above * step, 2000, 1e-9 * Vec3::UnitX()), unbounded);
}

// Two balls that slide and turn against each other: k_s (2/m + 2 l^2/I), held
// together by smooth walls.
TEST(EngineNetworkStep, PairInShear)
{
  constexpr double overlap = 1e-8;
  for (const double beta : {0., 0.27})
  {
    dem::EngineParameters p = frictional();
    p.wall.friction = 0.;
    p.particle.shear_damping = beta;
    p.particle.rolling_friction = 1e6; // does not act in this mode
    const double modulus =
        p.particle.shear_modulus / (1. - p.particle.poisson_ratio);
    const double force =
        4. / 3. * modulus * std::sqrt(0.5 * radius) * std::pow(overlap, 1.5);
    p.wall.normal_stiffness = 1e4;
    const double wall_overlap = force / p.wall.normal_stiffness;
    const auto make = [&]
    {
      dem::Engine engine(p);
      support::add_sphere(engine, radius, {radius - wall_overlap, 0., 0.});
      support::add_sphere(engine, radius,
                          {3. * radius - wall_overlap - overlap, 0., 0.});
      dem::add_plane(engine, Vec3::Zero(), Vec3::UnitX());
      dem::add_plane(
          engine, (4. * radius - 2. * wall_overlap - overlap) * Vec3::UnitX(),
          -Vec3::UnitX());
      engine.advance(1e-15);
      engine.come_to_rest();
      return engine;
    };
    dem::Engine engine = make();
    const double mass = engine.particles().mass(0);
    const double g = p.particle.shear_modulus, nu = p.particle.poisson_ratio;
    // k_s = 8 G* a, 1/G* = 2 (2 - nu) / G, a = sqrt(R* delta)
    const double shear = 4. * g / (2. - nu) * std::sqrt(0.5 * radius * overlap);
    const double exact =
        2. * std::sqrt(mass / (7. * shear)) *
        (std::sqrt(1. + 3.5 * beta * beta) - std::sqrt(3.5) * beta);
    const dem::SpringNetwork network = dem::contact_springs(engine, 0.);
    const double step = dem::sharp_step(network);
    // The lever is shorter than the radius by half of 1e-6, and the force of
    // the contact turns with it: F/d = 3e-7 k_n.
    EXPECT_NEAR(step, exact, 1e-6 * exact);
    // Its bound counts the rolling spring, which rests in this mode.
    const double bound = dem::guaranteed_step(network).step;
    EXPECT_LE(bound, step);
    EXPECT_GT(bound, 0.9 * step);
    EXPECT_LT(growth(engine, below * step, 3000), bounded);
    dem::Engine again = make();
    EXPECT_GT(growth(again, above * step, 3000), unbounded);
  }
}

namespace
{
/// Balls of three sizes that have fallen into a box and come to rest.
dem::Engine settled(const dem::EngineParameters &parameters)
{
  dem::Engine engine(parameters);
  for (int d = 0; d < 3; ++d)
  {
    dem::add_plane(engine, Vec3::Zero(), Vec3::Unit(d));
    if (d < 2)
      dem::add_plane(engine, 0.06 * Vec3::Unit(d), -Vec3::Unit(d));
  }
  std::mt19937 generator(3);
  std::uniform_real_distribution<double> shift(-1e-3, 1e-3);
  for (int i = 0; i < 27; ++i)
    support::add_sphere(
        engine, radius * (0.6 + 0.2 * (i % 3)),
        Vec3(0.011 + 0.019 * (i % 3), 0.011 + 0.019 * (i / 3 % 3),
             0.011 + 0.02 * (i / 9)) +
            Vec3(shift(generator), shift(generator), shift(generator)));
  engine.set_local_damping(0.7);
  constexpr double dt = 1.5e-5;
  for (int pass = 0; pass < 12; ++pass)
  {
    support::advance(engine, dt, 2000);
    engine.come_to_rest();
  }
  engine.set_local_damping(parameters.local_damping);
  return engine;
}
} // namespace

// All springs and dashpots at work in a packing: the sharp step separates quiet
// from growth, the guaranteed one is quiet. At 1.02 of it growth ends at 200
// times the first speeds, see above.
TEST(EngineNetworkStep, PackingAtRest)
{
  dem::EngineParameters p = frictional();
  p.gravity = {0., 0., -500.};
  p.wall.normal_stiffness = 2e5;
  p.wall.shear_stiffness = 1.7e5;
  p.wall.normal_damping = p.wall.shear_damping = 0.3;
  p.particle.normal_damping = p.particle.shear_damping = 0.2;
  p.particle.rolling_friction = p.wall.rolling_friction = 1e6;
  dem::Engine engine = settled(p);
  const dem::SpringNetwork network = dem::contact_springs(engine, 0.);
  ASSERT_GT(network.n_contacts(), 27u);
  const double sharp = dem::sharp_step(network);
  const double bound = dem::guaranteed_step(network).step;
  EXPECT_LE(bound, sharp);
  EXPECT_GT(bound, 0.8 * sharp);
  constexpr double quiet = 100.;
  // Well above the speeds of the last settling; short, since balls on balls
  // roll away by a factor of e in some 140 steps.
  const Vec3 kick = Vec3::Constant(1e-6);
  EXPECT_LT(growth(engine, bound, 400, kick), quiet);
  engine = settled(p);
  EXPECT_LT(growth(engine, 0.98 * sharp, 400, kick), quiet);
  engine = settled(p);
  EXPECT_GT(growth(engine, 1.04 * sharp, 400, kick), 100. * quiet);
}

// A ball on its way to a plate that no list has yet: the spring of an impact
// at twice its speed, delta = (15 m v^2 / (16 E* sqrt(R)))^(2/5), k = 2 E*
// sqrt(R delta), or of as far as it gets before the horizon.
TEST(EngineNetworkStep, BallInFlight)
{
  dem::EngineParameters p = support::bare_parameters();
  p.wall.law = "hertz";
  p.wall.normal_damping = 0.62;
  dem::Engine engine(p);
  dem::add_plane(engine, Vec3::Zero(), Vec3::UnitZ());
  support::add_sphere(engine, radius, Vec3(0., 0., 0.5));
  engine.advance(1e-9);
  const double speed = 2.;
  engine.particles().velocity(0) = Vec3(0., 0., -speed);
  EXPECT_EQ(dem::contact_springs(engine, 0.).n_contacts(), 0u);
  const double mass = engine.particles().mass(0),
               plane_modulus = 2. * p.particle.shear_modulus /
                               (1. - p.particle.poisson_ratio);
  const double deepest = std::pow(15. * mass * 4. * speed * speed /
                                      (16. * plane_modulus * std::sqrt(radius)),
                                  0.4);
  // As far as the lists see there is nothing.
  EXPECT_EQ(dem::contact_springs(engine, 1e-6).n_contacts(), 0u);
  for (const double horizon : {0.02, 1.1 * engine.listed_gap() / (2. * speed)})
  {
    const dem::SpringNetwork network = dem::contact_springs(engine, horizon);
    ASSERT_EQ(network.n_contacts(), 1u);
    const double overlap = std::min(deepest, 2. * speed * horizon),
                 expected = 2. * plane_modulus * std::sqrt(radius * overlap);
    EXPECT_NEAR(network.normal_stiffness[0], expected, 1e-4 * expected);
    const double dashpot =
                     2. * p.wall.normal_damping * std::sqrt(mass * expected),
                 step = dem::guaranteed_step(network).step;
    EXPECT_NEAR((step * step * expected + 2. * step * dashpot) / mass, 4.,
                1e-3);
  }
}

namespace
{
/// A particle whose true surface has come `late` into a Hertz wall across -x,
/// and `pressed` further since [m]. Its lists are there before the wall is.
dem::SpringNetwork springs_of_late(bool in_drum, double late, double pressed)
{
  dem::EngineParameters p = support::bare_parameters();
  p.wall.law = "hertz";
  p.geometry.geometry = p.geometry.wall_geometry =
      dem::ContactGeometry::surface;
  dem::Engine engine(p);
  const auto series = std::make_shared<const dem::Coefficients>(
      dem::test::sphere_series(4, radius));
  engine.add_particle(dem::make_shape(series, radius),
                      Vec3(radius - late, 0., 0.), dem::Quaternion::Identity());
  dem::Drum drum;
  drum.axis = Vec3::UnitZ();
  drum.radius = 0.1;
  drum.length = 2.1 * radius; // the ends are near
  if (in_drum)
    dem::set_drum(engine, drum);
  engine.advance(1e-12);
  drum.centre.x() = drum.radius;
  if (in_drum)
    dem::set_drum(engine, drum);
  else
    dem::add_plane(engine, Vec3::Zero(), Vec3::UnitX());
  engine.advance(1e-12);
  engine.particles().position(0).x() -= pressed;
  return dem::contact_springs(engine, 0.);
}
} // namespace

// The overlap that a contact point was found with carries nothing: the spring
// is that of what is pressed on top, k = 2 E* sqrt(R delta).
TEST(EngineNetworkStep, ContactPointFoundLateOnAWall)
{
  const dem::ParticleMaterial particle = support::bare_parameters().particle;
  const double modulus =
                   2. * particle.shear_modulus / (1. - particle.poisson_ratio),
               pressed = 1e-6;
  for (const bool in_drum : {false, true})
  {
    EXPECT_EQ(springs_of_late(in_drum, 1e-4, -1e-9).n_contacts(), 0u);
    const dem::SpringNetwork network = springs_of_late(in_drum, 1e-4, pressed);
    ASSERT_EQ(network.n_contacts(), 1u);
    const double expected = 2. * modulus * std::sqrt(radius * pressed);
    EXPECT_NEAR(network.normal_stiffness[0], expected, 2e-3 * expected);
  }
}
