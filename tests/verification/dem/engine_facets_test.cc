#include "dem_scene.h"

#include <dem/engine_boundaries.h>

#include <gtest/gtest.h>

#include <random>
#include <shape/test_shapes.h>

// Triangles that lie in one plane must act as that plane.
namespace
{
constexpr double equivalent_radius = 0.01, gravity = 9.81;

dem::EngineParameters floor_parameters()
{
  dem::EngineParameters p = support::bare_parameters();
  p.wall.normal_stiffness = 2e5;
  p.wall.shear_stiffness = 1.7e5;
  p.wall.friction = 0.5;
  p.wall.rolling_friction = 0.02;
  p.wall.normal_damping = p.wall.shear_damping = 0.62;
  p.surface = p.wall;
  p.gravity = {0., 0., -gravity};
  return p;
}

/// A ball that touches the floor at (x, y).
dem::Engine ball_above(const dem::EngineParameters &parameters, double x,
                       double y)
{
  dem::Engine engine(parameters);
  support::add_sphere(engine, equivalent_radius, {x, y, equivalent_radius});
  return engine;
}

dem::Engine ball_on_plane(const dem::EngineParameters &parameters, double x,
                          double y)
{
  dem::Engine engine = ball_above(parameters, x, y);
  dem::add_plane(engine, dem::Vec3::Zero(), dem::Vec3::UnitZ());
  return engine;
}

dem::Engine ball_on_fan(const dem::EngineParameters &parameters, double x,
                        double y, const dem::FacetSurface &fan)
{
  dem::Engine engine = ball_above(parameters, x, y);
  dem::attach_surface(engine, fan);
  return engine;
}

double length(const dem::Triple<double> &v)
{
  return std::sqrt(dot(v, v));
}

double unit_time(const dem::Engine &engine)
{
  return std::sqrt(engine.particles().mass(0) /
                   engine.parameters().wall.normal_stiffness);
}

/// How deep the ball sinks into the floor by its weight [m].
double sunk_at_rest(dem::Engine engine)
{
  // The damped motion has fallen by exp(-0.62 x 50), below round-off.
  support::advance(engine, 0.1 * unit_time(engine), 500);
  return equivalent_radius - engine.particles().position(0).z();
}

/// A floor with hills that moves, its vertices with a mass.
dem::FacetSurface hills()
{
  std::mt19937 generator(5);
  std::uniform_real_distribution<double> some(-1., 1.);
  constexpr int n = 7;
  std::vector<dem::Vec3> position;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j)
      position.emplace_back(0.008 * (i - 3), 0.008 * (j - 3),
                            5e-4 * some(generator));
  std::vector<std::array<std::int32_t, 3>> triangles;
  for (int i = 0; i + 1 < n; ++i)
    for (int j = 0; j + 1 < n; ++j)
    {
      const int a = i * n + j, b = a + n;
      triangles.push_back({a, a + 1, b});
      triangles.push_back({a + 1, b + 1, b});
    }
  dem::FacetSurface surface = support::fixed_surface(position, triangles);
  for (std::size_t v = 0; v < position.size(); ++v)
  {
    surface.velocity[v] =
        0.1 * dem::Vec3(some(generator), some(generator), some(generator));
    surface.mass[v] = 1e-4;
  }
  return surface;
}

dem::EngineParameters sticky_parameters()
{
  dem::EngineParameters p = support::bare_parameters();
  p.surface.friction = 0.6;
  p.surface.normal_damping = p.surface.shear_damping = 0.3;
  return p;
}

/// Force and moment about the origin, or powers, of both sides of the facet
/// contacts, added up: what must vanish; and the size of what was added.
struct Balance
{
  dem::Vec3 force = dem::Vec3::Zero(), moment = dem::Vec3::Zero();
  double power = 0.;
  double force_size = 0., power_size = 0.;
};

Balance balance_of(const dem::Engine &engine)
{
  Balance sum;
  const dem::FacetSurface &surface = dem::surface(engine);
  for (std::size_t v = 0; v < surface.load.size(); ++v)
  {
    sum.force += surface.load[v];
    sum.moment += surface.position[v].cross(surface.load[v]);
    sum.power += surface.load[v].dot(surface.velocity[v]);
    sum.force_size += surface.load[v].norm();
    sum.power_size += std::abs(surface.load[v].dot(surface.velocity[v]));
  }
  const dem::ContactBatch &batch = dem::on_facets(engine);
  for (std::size_t k = 0; k < batch.size(); ++k)
  {
    if (!batch.is_touching(k))
      continue;
    const auto i = static_cast<std::size_t>(batch.a[k]);
    const dem::Vec3 &force = batch.load[k].force;
    sum.force += force;
    sum.moment +=
        engine.particles().position(i).cross(force) + batch.load[k].moment;
    // The particle feels the force where the surface does, which moves so:
    sum.power += force.dot(
        dem::facet_row(surface,
                       dem::facet_boundary(engine).contact_points.point[k],
                       dem::facet_boundary(engine).contact_points.point[k])
            .velocity);
  }
  return sum;
}

void expect_balanced(const dem::Engine &engine)
{
  const Balance sum = balance_of(engine);
  EXPECT_GT(sum.force_size, 1.); // N
  EXPECT_LT(sum.force.norm(), 1e-13 * sum.force_size);
  // Levers are below 0.05 m; moments are rounded (dem/contact/sum_grid.h).
  EXPECT_LT(sum.moment.norm(), 1e-13 * sum.force_size);
  EXPECT_LT(std::abs(sum.power), 1e-12 * sum.power_size);
}
} // namespace

// A contact per triangle would give 1/2, 1/4, 1/6 of the overlap.
TEST(EngineFacets, BallOnAFanSinksAsOnAPlane)
{
  const dem::EngineParameters p = floor_parameters();
  const double plane = sunk_at_rest(ball_on_plane(p, 0., 0.));
  const double exact = 4. / 3. * std::numbers::pi *
                       std::pow(equivalent_radius, 3) * p.particle.density *
                       gravity / p.wall.normal_stiffness;
  // The position has 16 digits, the overlap is 1e-4 of it.
  EXPECT_NEAR(plane / exact, 1., 1e-8);
  for (const int n : {2, 4, 6})
    for (const double x : {0., 1e-9, 1e-3})
    {
      dem::Engine engine =
          ball_on_fan(p, x, 0., support::coplanar_fan(n, 0.05, 0.4));
      EXPECT_NEAR(sunk_at_rest(std::move(engine)) / plane, 1., 1e-6)
          << n << " triangles, x = " << x;
    }
}

// Down a slight slope, over faces, edges and the vertex: at every step the one
// contact carries what the plane's does, shear and rolling springs included,
// whatever the triangles. Both engines do the same sums but for the nearest
// point, which costs 1e-16 of a metre: 1e-11 of the overlap a step.
TEST(EngineFacets, RollingOverFacetsIsRollingOnAPlane)
{
  dem::EngineParameters p = floor_parameters();
  p.gravity = {0.5, 0., -gravity};
  for (const double y : {0., 2e-3})
    for (const int n : {2, 4, 6})
      for (const double angle : {0., 0.2, std::numbers::pi / 6.})
      {
        dem::Engine plane = ball_on_plane(p, -0.03, y);
        dem::Engine fan =
            ball_on_fan(p, -0.03, y, support::coplanar_fan(n, 0.2, angle));
        for (dem::Engine *engine : {&plane, &fan})
        {
          engine->particles().velocity(0).x() = 0.3;
          engine->particles().spin(0).y() = 0.3 / equivalent_radius;
        }
        const double dt = 0.1 * unit_time(plane);
        const double weight = plane.particles().mass(0) * gravity;
        while (plane.particles().position(0).x() < 0.03)
        {
          plane.advance(dt);
          fan.advance(dt);
          const std::size_t k =
              support::only_nearest_point(dem::on_facets(fan));
          const std::size_t one =
              support::only_nearest_point(dem::on_planes(plane));
          ASSERT_LT(one, dem::on_planes(plane).size());
          ASSERT_LT(k, dem::on_facets(fan).size())
              << n << " triangles, x = " << plane.particles().position(0).x();
          const auto a = dem::on_planes(plane).history(one);
          const auto b = dem::on_facets(fan).history(k);
          ASSERT_NEAR(a.normal_force, b.normal_force, 1e-6 * weight);
          ASSERT_LT(length(a.shear - b.shear), 1e-6 * weight);
          ASSERT_LT(length(a.rolling - b.rolling),
                    1e-6 * weight * equivalent_radius);
        }
        // In the end the load is the weight, and the springs are loaded.
        const std::size_t k = support::only_nearest_point(dem::on_facets(fan));
        const auto b = dem::on_facets(fan).history(k);
        EXPECT_NEAR(b.normal_force, weight, 1e-6 * weight);
        EXPECT_GT(length(b.shear), 1e-3 * weight);
        EXPECT_GT(length(b.rolling), 1e-3 * weight * equivalent_radius);
      }
}

// Forces, moments and powers of both sides, for balls and for a shape pressed
// into hills that move.
TEST(EngineFacets, LoadsOfASphereAreConservative)
{
  dem::Engine engine(sticky_parameters());
  support::add_sphere(engine, equivalent_radius, {0.001, 0.002, 0.0095});
  support::add_sphere(engine, equivalent_radius, {-0.012, -0.011, 0.0097});
  dem::attach_surface(engine, hills());
  engine.particles().velocity(0) = {0.1, 0.2, -0.1};
  engine.particles().spin(0) = {3., -2., 1.};
  for (int step = 0; step < 20; ++step)
  {
    engine.advance(1e-7);
    expect_balanced(engine);
  }
}

TEST(EngineFacets, LoadsOfAShapeAreConservative)
{
  auto series = std::make_shared<const dem::Coefficients>(
      dem::test::random_particle(20, 3));
  dem::Engine engine(sticky_parameters());
  engine.add_particle(dem::make_shape(series, equivalent_radius),
                      {0.001, 0.002, 0.008},
                      dem::Quaternion(0.5, 0.5, -0.5, 0.5));
  dem::attach_surface(engine, hills());
  engine.particles().velocity(0) = {0.1, 0.2, -0.1};
  engine.particles().spin(0) = {3., -2., 1.};
  for (int step = 0; step < 20; ++step)
  {
    engine.advance(1e-7);
    expect_balanced(engine);
  }
}

// A ball that a moving surface lifts: the work of the surface is what the
// ball has gained, dashpots and sliding included.
TEST(EngineFacets, WorkOfTheSurfaceIsBooked)
{
  dem::EngineParameters p = sticky_parameters();
  p.surface.normal_stiffness = 1e6;
  p.surface.shear_stiffness = 8e5;
  dem::Engine engine(p);
  support::add_sphere(engine, equivalent_radius, {0., 0., equivalent_radius});
  dem::FacetSurface fan = support::coplanar_fan(6, 0.05, 0.);
  const dem::Vec3 velocity(0.1, 0.05, 0.2);
  fan.velocity.assign(fan.velocity.size(), velocity);
  dem::attach_surface(engine, fan);
  const double dt = 2e-3 * std::sqrt(engine.particles().mass(0) / 1e6);
  for (int step = 0; step < 4000; ++step)
  {
    for (dem::Vec3 &x : dem::surface(engine).position)
      x += dt * velocity;
    engine.advance(dt);
  }
  EXPECT_GT(engine.particles().velocity(0).z(), 0.25);
  // Second order in the step, but for the moment of touch and of leaving.
  EXPECT_NEAR(support::energy_residual(engine), 0.,
              2e-3 * engine.energy().work_of("facets"));
}

namespace
{
/// Overlap of a ball with the nearest triangle of all, 0 if it is free [m].
double brute_overlap(const dem::Engine &engine, std::size_t ball)
{
  const dem::FacetSurface &surface = dem::surface(engine);
  double least = engine.particles().radius(ball);
  for (std::size_t t = 0; t < surface.triangles.size(); ++t)
    least = std::min(
        least, dem::nearest_on_facet(surface, static_cast<std::int32_t>(t),
                                     engine.particles().position(ball))
                   .distance);
  return engine.particles().radius(ball) - least;
}

/// Whether several facets carry the ball at one of its contacts.
bool is_shared(const dem::Engine &engine, std::size_t ball)
{
  const dem::ContactBatch &batch = dem::on_facets(engine);
  for (std::size_t k = 0; k < batch.size(); ++k)
    if (batch.a[k] == static_cast<std::int32_t>(ball) && batch.is_touching(k) &&
        !dem::facet_boundary(engine).contact_points.point[k].shares.of.empty())
      return true;
  return false;
}

/// Largest overlap of each ball with the surface, as the engine has it [m].
std::vector<double> overlaps(const dem::Engine &engine)
{
  std::vector<double> largest(engine.particles().size(), 0.);
  const dem::ContactBatch &batch = dem::on_facets(engine);
  for (std::size_t k = 0; k < batch.size(); ++k)
  {
    double &one = largest[static_cast<std::size_t>(batch.a[k])];
    one = std::max(one, batch.overlap[k]);
  }
  return largest;
}
} // namespace

// Triangles and balls that cannot touch yet are left alone for a while: never
// for too long, whatever moves.
TEST(EngineFacets, NoTouchIsMissed)
{
  dem::EngineParameters p = floor_parameters();
  p.surface.normal_stiffness = 1e4;
  dem::Engine engine(p);
  std::mt19937 generator(11);
  std::uniform_real_distribution<double> some(-1., 1.);
  for (int i = 0; i < 8; ++i)
  {
    const double radius = i % 2 == 0 ? 4e-3 : 1.2e-3;
    support::add_sphere(engine, radius,
                        {0.006 * (i % 4 - 1.5), 0.008 * (i / 4 - 0.5),
                         1e-3 + 2. * radius + 1e-3 * some(generator)});
    engine.particles().velocity(static_cast<std::size_t>(i)) = {
        0.2 * some(generator), 0.2 * some(generator), -0.3};
  }
  dem::attach_surface(engine, hills());
  constexpr double dt = 2e-5;
  std::int64_t n_touches = 0;
  for (int step = 0; step < 4000; ++step)
  {
    dem::FacetSurface &surface = dem::surface(engine);
    const double beat = std::cos(200. * step * dt);
    for (std::size_t v = 0; v < surface.position.size(); ++v)
    {
      surface.velocity[v] = {0., 0., (v % 2 == 0 ? 0.05 : -0.05) * beat};
      surface.position[v] += dt * surface.velocity[v];
    }
    engine.advance(dt);
    const std::vector<double> found = overlaps(engine);
    for (std::size_t i = 0; i < found.size(); ++i)
    {
      // Where several carry it they carry no less than the nearest.
      const double nearest = brute_overlap(engine, i);
      ASSERT_GE(found[i], nearest - 1e-14) << i << ' ' << step;
      ASSERT_LE(found[i], (is_shared(engine, i) ? 4. : 1.) * nearest + 1e-14)
          << i << ' ' << step;
      n_touches += found[i] > 0.;
    }
  }
  EXPECT_GT(n_touches, 2000);
}

namespace
{
/// Two halves of a valley along y with these slopes; particles lie above.
std::array<dem::FacetSurface, 2> valley(double slope)
{
  std::array<dem::FacetSurface, 2> halves;
  for (const int side : {0, 1})
  {
    const double x = side == 0 ? -0.05 : 0.05;
    const std::array<std::int32_t, 3> first =
        side == 0 ? std::array<std::int32_t, 3>{2, 1, 0}
                  : std::array<std::int32_t, 3>{0, 1, 2};
    halves[static_cast<std::size_t>(side)] = support::fixed_surface(
        {{0., -0.05, 0.}, {0., 0.05, 0.}, {x, 0., std::abs(x) * slope}},
        {first});
  }
  return halves;
}
} // namespace

// A ball in a valley whose slopes are two surfaces: each carries what the
// equilibrium of the ball asks for, by its own law, and both sums of impulses
// are the momentum that gravity has given.
TEST(EngineFacets, TwoSurfacesCarryTheBallBetweenThem)
{
  dem::EngineParameters p = floor_parameters();
  p.surface.friction = 0.;
  p.surface.rolling_friction = 0.;
  dem::Engine engine(p);
  const double slope = 0.75, cosine = 0.8;
  support::add_sphere(engine, equivalent_radius,
                      {0., 0., equivalent_radius / cosine});
  dem::WallMaterial soft = p.surface;
  soft.normal_stiffness = 0.5 * p.surface.normal_stiffness;
  const auto halves = valley(slope);
  EXPECT_EQ(dem::add_surface(engine, "left", p.surface, halves[0]), 0u);
  EXPECT_EQ(dem::add_surface(engine, "right", soft, halves[1]), 1u);
  EXPECT_THROW(dem::add_surface(engine, "left", soft, halves[0]),
               std::invalid_argument);
  const double dt = 0.1 * unit_time(engine);
  support::advance(engine, dt, 2000);

  const double weight = gravity * engine.particles().mass(0);
  const double normal = 0.5 * weight / cosine; // on each slope
  for (std::size_t s = 0; s < 2; ++s)
  {
    dem::Vec3 load = dem::Vec3::Zero();
    for (const dem::Vec3 &on_vertex : dem::surface(engine, s).load)
      load += on_vertex;
    EXPECT_NEAR(load.norm(), normal, 1e-9 * normal) << s;
    const std::size_t k =
        support::only_nearest_point(dem::on_facets(engine, s));
    ASSERT_LT(k, dem::on_facets(engine, s).size());
    const double stiffness =
        dem::facet_boundary(engine, s).material.normal_stiffness;
    EXPECT_NEAR(dem::on_facets(engine, s).overlap[k], normal / stiffness,
                1e-9 * normal / stiffness)
        << s;
  }
  dem::Vec3 impulse = dem::Vec3::Zero();
  for (const dem::FacetBoundary &facets : dem::surfaces(engine))
    for (const dem::Vec3 &part : facets.impulse)
      impulse += part;
  EXPECT_NEAR(impulse.z(), -weight * engine.time(),
              1e-9 * weight * engine.time());
}
