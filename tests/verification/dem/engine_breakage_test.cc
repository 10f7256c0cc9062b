#include "dem_scene.h"

#include <dem/shape/patch.h>

#include <gtest/gtest.h>

#include <shape/test_shapes.h>

// Stones pressed until they break, in the engine.
namespace
{
using Series = std::shared_ptr<const dem::Coefficients>;

constexpr double fracture_energy = 1e4; // G_c [J/m^2]
const dem::Vec3 axes(0.012, 0.010, 0.008);

/// An ellipsoid of order 20, the long axis along x; error below 1e-8.
Series ellipsoid()
{
  static const Series series = std::make_shared<const dem::Coefficients>(
      dem::test::project(20, [](const dem::Vec3 &s)
                         { return dem::test::ellipsoid_radius(axes, s); }));
  return series;
}

dem::Body stone(const Series &series)
{
  return dem::make_body(series, series->front() * dem::ball_radius_factor);
}

/// R = 1 / sqrt(K_G) at the tip of the long axis: b c / a [m].
double tip_radius()
{
  return axes.y() * axes.z() / axes.x();
}

dem::EngineParameters press_parameters()
{
  dem::EngineParameters p = support::bare_parameters();
  p.breakage.is_active = true;
  p.breakage.fracture_energy = fracture_energy;
  p.wall.normal_stiffness = 1e8;
  p.wall.normal_damping = 0.2;
  return p;
}

struct Press
{
  dem::Engine engine;
  double time_step = 0.; // [s]

  /// Both plates close on the stone at this speed, from touch [m/s].
  Press(const dem::EngineParameters &parameters, const dem::Body &body,
        const dem::Vec3 &turned, double speed)
      : engine(parameters)
  {
    engine.add_stone(
        body, dem::Vec3::Zero(),
        dem::Quaternion::FromTwoVectors(turned, dem::Vec3::UnitX()));
    const auto reach = [&](const dem::Vec3 &u)
    {
      return body.series ? body.scale * dem::radius(*body.series, u)
                         : body.scale;
    };
    engine.add_plane({-reach(-turned), 0., 0.}, dem::Vec3::UnitX());
    engine.add_plane({reach(turned), 0., 0.}, -dem::Vec3::UnitX());
    engine.planes()[0].velocity.x() = speed;
    engine.planes()[1].velocity.x() = -speed;
    time_step = 0.1 * std::sqrt(engine.particles().mass(0) /
                                parameters.wall.normal_stiffness);
  }

  double force() const { return std::abs(engine.planes()[1].force.x()); }

  /// Advances until the force passes this, something breaks or 20 ms are over.
  std::vector<dem::BreakageEvent> load_to(double limit)
  {
    std::vector<dem::BreakageEvent> events;
    while (force() < limit && events.empty() && engine.time() < 0.02)
    {
      engine.advance(time_step);
      events = engine.take_events();
    }
    return events;
  }
};

constexpr double slow = 5e-3; // plates, m/s: 250 N/ms
} // namespace

// l = F / (2 pi R G_c) on a linear wall (MODEL 6.1). In n steps the sum of
// Eq. 4 falls short of it by ln(n) / 2n, n = 4000: 1e-3. G_c or R wrong by 1 %
// moves it by as much.
TEST(EngineBreakage, FirstEventOnAWallComesAtTheClosedForm)
{
  Press press(press_parameters(), stone(ellipsoid()), dem::Vec3::UnitX(),
              0.2 * slow);
  const std::vector<dem::BreakageEvent> events = press.load_to(1e4);
  ASSERT_FALSE(events.empty());
  const double exact = 2. * std::numbers::pi * tip_radius() * fracture_energy;
  EXPECT_NEAR(events[0].force_before / exact, 1., 2e-3);
  EXPECT_EQ(events[0].mode, dem::BreakageMode::cumulative);
  EXPECT_EQ(events[0].kind, 1);
  // Both tips are alike and broke in this step.
  EXPECT_EQ(events.size(), 2u);
  // Caps by the curvature of the tip: A_i = 2 pi R delta, V_i = A_i delta / 2.
  const double overlap = events[0].overlap;
  const double volume = std::numbers::pi * tip_radius() * overlap * overlap;
  EXPECT_NEAR(events[0].removed_volume / volume, 1., 1e-5);
  EXPECT_NEAR(
      events[0].fracture_energy /
          (2. * std::numbers::pi * tip_radius() * overlap * fracture_energy),
      1., 1e-5);
  EXPECT_NEAR(events[0].elastic_energy /
                  (0.5 * events[0].force_before * overlap),
              1., 1e-12);
}

// l = F / (3 pi R G_c) between two stones, tip to tip; so heavy that their
// motion is given. The sum takes 3000 steps: 2e-3 as above.
TEST(EngineBreakage, FirstEventOfTwoStonesComesAtTheClosedForm)
{
  dem::EngineParameters p = press_parameters();
  p.stone.density = 1e9;
  dem::Engine engine(p);
  for (const double side : {-1., 1.})
  {
    engine.add_stone(stone(ellipsoid()), side * axes.x() * dem::Vec3::UnitX(),
                     dem::Quaternion::Identity());
    engine.particles().last().velocity.x() = -side * 0.1;
  }
  const double exact = 3. * std::numbers::pi * tip_radius() * fracture_energy;
  std::vector<dem::BreakageEvent> events;
  double before = 0.;
  while (events.empty() && engine.time() < 1e-2)
  {
    before = engine.energy().elastic;
    engine.advance(1e-6);
    events = engine.take_events();
  }
  ASSERT_EQ(events.size(), 1u); // one side of a contact a step
  EXPECT_NEAR(events[0].force_before / exact, 1., 2e-3);
  EXPECT_EQ(events[0].mode, dem::BreakageMode::cumulative);
  EXPECT_EQ(events[0].kind, 0);
  EXPECT_LT(events[0].force_after, 0.9 * events[0].force_before);
  EXPECT_NEAR(events[0].elastic_energy / before, 1., 5e-3);
  EXPECT_NEAR(engine.energy().elastic,
              events[0].elastic_energy - events[0].released_energy,
              1e-12 * before);
  EXPECT_NEAR(
      (engine.particles().load[0].force + engine.particles().load[1].force)
          .norm(),
      0., 1e-10);
}

// Crushed on until some 30 pieces are off.
TEST(EngineBreakage, ForceDropsMassAndEnergyAreBooked)
{
  Press press(press_parameters(), stone(ellipsoid()), dem::Vec3::UnitX(), slow);
  dem::Engine &engine = press.engine;
  const double volume = engine.particles().body[0].volume;
  double removed = 0., fractured = 0., released = 0.;
  std::size_t n_events = 0;
  while (n_events < 30 && engine.time() < 0.02)
  {
    for (const dem::BreakageEvent &event : press.load_to(1e4))
    {
      EXPECT_LT(event.force_after, event.force_before);
      EXPECT_GT(event.released_energy, 0.);
      removed += event.removed_volume;
      fractured += event.fracture_energy;
      released += event.released_energy + event.kinetic_energy;
      ++n_events;
    }
  }
  ASSERT_GE(n_events, 30u);
  EXPECT_EQ(engine.n_events(), static_cast<std::int64_t>(n_events));
  // Volumes are sums over 3200 nodes of 1e-6 m^3 each, to 1e-16 of that.
  const double loss = dem::abrasion(engine.particles());
  EXPECT_GT(loss, 1e-7);
  EXPECT_NEAR(loss, removed / volume, 1e-13);
  EXPECT_NEAR(engine.particles().mass(0),
              engine.particles().body[0].volume *
                  engine.parameters().stone.density,
              1e-15);
  const dem::EngineEnergy e = engine.energy();
  EXPECT_NEAR(e.fracture, fractured, 1e-12 * fractured);
  EXPECT_NEAR(e.breakage, released, 1e-12 * released);
  EXPECT_GT(e.plane_work, 5e-3);
  EXPECT_NEAR(support::energy_residual(engine), 0., 0.01 * e.plane_work);
}

// A skew irregular stone breaks too, and keeps its books.
TEST(EngineBreakage, IrregularStoneKeepsItsBooks)
{
  dem::EngineParameters p = press_parameters();
  p.wall.friction = 0.5;
  p.wall.shear_damping = 0.2;
  const auto series =
      std::make_shared<const dem::Coefficients>(dem::test::random_stone(20, 3));
  Press press(p, stone(series), dem::Vec3(1., 2., -1.).normalized(), slow);
  dem::Engine &engine = press.engine;
  const double volume = engine.particles().body[0].volume;
  double removed = 0.;
  while (engine.n_events() < 200 && engine.time() < 0.02)
    for (const dem::BreakageEvent &event : press.load_to(1e4))
    {
      EXPECT_LT(event.force_after, event.force_before);
      removed += event.removed_volume;
    }
  EXPECT_GE(engine.n_events(), 200);
  EXPECT_NEAR(dem::abrasion(engine.particles()), removed / volume, 1e-13);
  EXPECT_NEAR(support::energy_residual(engine), 0.,
              0.01 * engine.energy().plane_work);
}

// kappa r_ins = 1 everywhere: no corner, whatever the load.
TEST(EngineBreakage, PerfectSphereNeverBreaks)
{
  const auto series = std::make_shared<const dem::Coefficients>(
      dem::test::sphere_series(20, 0.01));
  const double limit = 4. * std::numbers::pi * 0.01 * fracture_energy;
  for (const dem::Body &body : {stone(series), dem::make_sphere(0.01)})
  {
    Press press(press_parameters(), body, dem::Vec3::UnitX(), 10. * slow);
    EXPECT_TRUE(press.load_to(10. * limit).empty());
    EXPECT_EQ(dem::abrasion(press.engine.particles()), 0.);
  }
}

// Switched off, or a stone below the size from which stones break.
TEST(EngineBreakage, NothingBreaksThatMayNot)
{
  const double limit =
      10. * 2. * std::numbers::pi * tip_radius() * fracture_energy;
  dem::EngineParameters off = press_parameters();
  off.breakage.is_active = false;
  dem::EngineParameters small = press_parameters();
  small.breakage.min_diameter = 2.1 * axes.x();
  for (const dem::EngineParameters &p : {off, small})
  {
    Press press(p, stone(ellipsoid()), dem::Vec3::UnitX(), 10. * slow);
    EXPECT_TRUE(press.load_to(limit).empty());
    EXPECT_EQ(press.engine.n_events(), 0);
    EXPECT_EQ(dem::abrasion(press.engine.particles()), 0.);
  }
}
