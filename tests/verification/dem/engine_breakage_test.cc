#include "dem_scene.h"

#include <dem/engine_boundaries.h>
#include <dem/measure/assembly.h>
#include <dem/shape/patch.h>

#include <gtest/gtest.h>

#include <map>
#include <shape/test_shapes.h>
#include <vector>

// Particles pressed until they break, in the engine.
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

dem::ParticleShape particle(const Series &series)
{
  return dem::make_shape(series,
                         series->front() * dem::equivalent_radius_factor);
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

  /// Both plates close on the particle at this speed, from touch [m/s].
  Press(const dem::EngineParameters &parameters, const dem::ParticleShape &body,
        const dem::Vec3 &turned, double speed)
      : engine(parameters)
  {
    engine.add_particle(
        body, dem::Vec3::Zero(),
        dem::Quaternion::FromTwoVectors(turned, dem::Vec3::UnitX()));
    const auto reach = [&](const dem::Vec3 &u)
    {
      return body.series ? body.scale * dem::radius(*body.series, u)
                         : body.scale;
    };
    dem::add_plane(engine, {-reach(-turned), 0., 0.}, dem::Vec3::UnitX());
    dem::add_plane(engine, {reach(turned), 0., 0.}, -dem::Vec3::UnitX());
    dem::planes(engine)[0].velocity.x() = speed;
    dem::planes(engine)[1].velocity.x() = -speed;
    time_step = 0.1 * std::sqrt(engine.particles().mass(0) /
                                parameters.wall.normal_stiffness);
  }

  double force() const { return std::abs(dem::planes(engine)[1].force.x()); }

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

// A skew irregular particle breaks too, and keeps its books.
TEST(EngineBreakage, IrregularParticleKeepsItsBooks)
{
  dem::EngineParameters p = press_parameters();
  p.wall.friction = 0.5;
  p.wall.shear_damping = 0.2;
  const auto series = std::make_shared<const dem::Coefficients>(
      dem::test::random_particle(20, 3));
  Press press(p, particle(series), dem::Vec3(1., 2., -1.).normalized(), slow);
  dem::Engine &engine = press.engine;
  const double volume = engine.particles().shape[0].volume;
  double removed = 0.;
  while (engine.n_events() < 200 && engine.time() < 0.02)
    for (const dem::BreakageEvent &event : press.load_to(1e4))
    {
      EXPECT_LT(event.force_after, event.force_before);
      removed += event.removed_volume;
    }
  EXPECT_GE(engine.n_events(), 200);
  EXPECT_NEAR(dem::abrasion(engine.particles(), *dem::one_rank()),
              removed / volume, 1e-13);
  EXPECT_NEAR(support::energy_residual(engine), 0.,
              0.01 * engine.energy().work_of("planes"));
}

// kappa r_ins = 1 everywhere: no corner, whatever the load.
TEST(EngineBreakage, PerfectSphereNeverBreaks)
{
  const auto series = std::make_shared<const dem::Coefficients>(
      dem::test::sphere_series(20, 0.01));
  const double limit = 4. * std::numbers::pi * 0.01 * fracture_energy;
  for (const dem::ParticleShape &body :
       {particle(series), dem::make_sphere(0.01)})
  {
    Press press(press_parameters(), body, dem::Vec3::UnitX(), 10. * slow);
    EXPECT_TRUE(press.load_to(10. * limit).empty());
    EXPECT_EQ(dem::abrasion(press.engine.particles(), *dem::one_rank()), 0.);
  }
}

// Switched off, or a particle below the size from which particles break.
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
    Press press(p, particle(ellipsoid()), dem::Vec3::UnitX(), 10. * slow);
    EXPECT_TRUE(press.load_to(limit).empty());
    EXPECT_EQ(press.engine.n_events(), 0);
    EXPECT_EQ(dem::abrasion(press.engine.particles(), *dem::one_rank()), 0.);
  }
}

namespace
{
/// Force of the first event on the tip between linear walls [N].
double first_event()
{
  return 2. * std::numbers::pi * tip_radius() * fracture_energy;
}

/// Factor of the contact with plate 1 [-].
double factor(const Press &press)
{
  const dem::ContactBatch &batch = dem::on_planes(press.engine);
  for (std::size_t k = 0; k < batch.size(); ++k)
    if (batch.b[k] == 1)
      return batch.factor_a[k];
  return 0.;
}

/// Plates that go this way for so many steps [m/s].
void drive(Press &press, double speed, int n_steps)
{
  dem::planes(press.engine)[0].velocity.x() = speed;
  dem::planes(press.engine)[1].velocity.x() = -speed;
  support::advance(press.engine, press.time_step, n_steps);
}

/// Growth of the factor in 500 swings of 0.1 % of the force, at rest under a
/// third of the force of an event.
double damage_of_noise(double hysteresis)
{
  dem::EngineParameters p = press_parameters();
  p.breakage.hysteresis = hysteresis;
  Press press(p, particle(ellipsoid()), dem::Vec3::UnitX(), slow);
  press.load_to(first_event() / 3.);
  drive(press, 0., 1000);
  const double before = factor(press);
  constexpr int n = 50;
  const double swing = 1e-3 * press.force() / p.wall.normal_stiffness;
  for (int cycle = 0; cycle < 500; ++cycle)
    for (const double sign : {-1., 1.})
      drive(press, sign * swing / (n * press.time_step), n);
  return factor(press) - before;
}

/// Growth of the factor under load, from a twentieth to a tenth of the force of
/// an event, where rises count so many times from there on.
double worn_when_set(dem::ContactGeometry geometry, double repetitions)
{
  dem::EngineParameters p = press_parameters();
  p.geometry.geometry = p.geometry.wall_geometry = geometry;
  Press press(p, particle(ellipsoid()), dem::Vec3::UnitX(), slow);
  EXPECT_TRUE(press.load_to(0.05 * first_event()).empty());
  const double before = factor(press);
  press.engine.set_repetitions(repetitions);
  EXPECT_TRUE(press.load_to(0.1 * first_event()).empty());
  return factor(press) - before;
}

/// Growth of the factor while pressed to a twentieth of the force of an event,
/// let go, and pressed again, when rises count so many times.
std::vector<double> worn_by_loads(double repetitions)
{
  Press press(press_parameters(), particle(ellipsoid()), dem::Vec3::UnitX(),
              slow);
  std::vector<double> worn;
  for (int load = 0; load < 3; ++load)
  {
    const double before = factor(press);
    press.engine.set_repetitions(repetitions);
    EXPECT_TRUE(press.load_to(0.05 * first_event()).empty());
    worn.push_back(factor(press) - before);
    while (press.force() > 0.01 * first_event())
      drive(press, -slow, 1);
    drive(press, slow, 0);
    press.engine.set_repetitions(1.); // between two steps, as a jump does
  }
  return worn;
}
} // namespace

// Read literally, every swing counts its 0.1 % of a third: 500 make a sixth.
TEST(EngineBreakage, NoiseAtRestDoesNoDamage)
{
  EXPECT_NEAR(damage_of_noise(0.), 500. * 1e-3 / 3., 0.02);
  EXPECT_EQ(damage_of_noise(dem::BreakageParameters{}.hysteresis), 0.);
}

// Pressed to 0.6 of the force of an event, let go, and pressed to 0.6 again.
TEST(EngineBreakage, PatchKeepsTheFactor)
{
  using enum dem::FactorMemory;
  for (const dem::FactorMemory memory : {contact, patch})
  {
    dem::EngineParameters p = press_parameters();
    p.breakage.memory = memory;
    Press press(p, particle(ellipsoid()), dem::Vec3::UnitX(), slow);
    EXPECT_TRUE(press.load_to(0.6 * first_event()).empty());
    EXPECT_NEAR(factor(press), 0.6, 0.03);
    while (press.force() > 0.)
      drive(press, -slow, 10);
    drive(press, -slow, 50);
    EXPECT_EQ(factor(press), 0.);
    drive(press, slow, 0);
    EXPECT_EQ(press.load_to(0.6 * first_event()).empty(), memory == contact);
    EXPECT_LT(press.engine.time(), 0.02);
  }
}

// A soft wall lets the particle sink in, a narrow kernel takes off more than
// the overlap: the event opens its contact. One step that counts many times
// takes the factor past 1; the rest of it is lost, or waits on the patch.
TEST(EngineBreakage, PatchKeepsTheFactorOfAContactThatAnEventOpens)
{
  using enum dem::FactorMemory;
  for (const dem::FactorMemory memory : {contact, patch})
  {
    dem::EngineParameters p = press_parameters();
    p.wall.normal_stiffness = 4e5;
    p.breakage.memory = memory;
    p.breakage.kernel_floor = 1.;
    p.breakage.kernel_scale = 0.5;
    Press press(p, particle(ellipsoid()), dem::Vec3::UnitX(), 40. * slow);
    EXPECT_TRUE(press.load_to(0.5 * first_event()).empty());
    const double before = factor(press);
    press.engine.advance(press.time_step);
    const double step = factor(press) - before;
    ASSERT_GT(step, 0.);
    // 1.5 after the next step, 0.5 when one is taken off.
    press.engine.set_repetitions((1.5 - factor(press)) / step);
    press.engine.advance(press.time_step);
    const auto events = press.engine.take_events();
    ASSERT_EQ(events.size(), 2u); // one at either plate
    ASSERT_EQ(events[1].force_after, 0.);
    EXPECT_EQ(factor(press), 0.);
    press.engine.set_repetitions(1.);
    while (press.force() == 0. && press.engine.time() < 0.02)
      press.engine.advance(press.time_step);
    EXPECT_NEAR(factor(press), memory == patch ? 0.5 : 0., 0.05);
  }
}

// A rise that counts five times: the first event at a fifth of the force; one
// that counts for nothing: none.
TEST(EngineBreakage, RepetitionsMultiplyTheFactor)
{
  constexpr double share = 0.15;
  Press once(press_parameters(), particle(ellipsoid()), dem::Vec3::UnitX(),
             slow);
  EXPECT_TRUE(once.load_to(share * first_event()).empty());
  Press often(press_parameters(), particle(ellipsoid()), dem::Vec3::UnitX(),
              slow);
  often.engine.set_repetitions(5.);
  EXPECT_TRUE(often.load_to(share * first_event()).empty());
  // Turns of the energy are in single precision.
  EXPECT_NEAR(factor(often), 5. * factor(once), 1e-6);
  const auto events = often.load_to(first_event());
  ASSERT_FALSE(events.empty());
  EXPECT_NEAR(events[0].force_before, 0.2 * first_event(),
              0.03 * 0.2 * first_event());

  Press never(press_parameters(), particle(ellipsoid()), dem::Vec3::UnitX(),
              slow);
  never.engine.set_repetitions(0.);
  EXPECT_TRUE(never.load_to(2. * first_event()).empty());
  EXPECT_EQ(factor(never), 0.);
}

TEST(EngineBreakage, RepetitionsMayBeginUnderLoad)
{
  using enum dem::ContactGeometry;
  for (const dem::ContactGeometry geometry : {radial, surface})
  {
    const double once = worn_when_set(geometry, 1.);
    EXPECT_GT(once, 0.03);
    EXPECT_NEAR(worn_when_set(geometry, 5.), 5. * once, 1e-5);
  }
}

// Pressed to a tenth of the force of an event, half let go, and pressed beyond:
// five times what is new, once what makes up for the fall. By the force of the
// spring, which the criterion sees.
TEST(EngineBreakage, WhatMakesUpForAFallCountsOnce)
{
  Press press(press_parameters(), particle(ellipsoid()), dem::Vec3::UnitX(),
              slow);
  const auto spring = [&press]
  {
    const dem::ContactBatch &batch = dem::on_planes(press.engine);
    return batch.normal_force[batch.b[0] == 1 ? 0 : 1] / first_event();
  };
  press.engine.set_repetitions(5.);
  EXPECT_TRUE(press.load_to(0.1 * first_event()).empty());
  const double before = factor(press), highest = spring();
  while (press.force() > 0.05 * first_event())
    drive(press, -slow, 1);
  const double lowest = spring();
  drive(press, slow, 0);
  EXPECT_TRUE(press.load_to(0.12 * first_event()).empty());
  const double counted = highest - lowest + 5. * (spring() - highest);
  EXPECT_GT(highest - lowest, 0.03);
  EXPECT_NEAR(factor(press) - before, counted, 0.01 * counted);
}

// A load cycle begins anew with each set_repetitions(): all count as often.
TEST(EngineBreakage, EveryLoadCountsAsOften)
{
  const std::vector<double> once = worn_by_loads(1.), often = worn_by_loads(5.);
  EXPECT_GT(once.back(), 0.02);
  for (std::size_t load = 0; load < once.size(); ++load)
    EXPECT_NEAR(often[load], 5. * once[load], 1e-6) << load;
}

namespace
{
/// Of the first event of a particle pressed on the tip of another solid, which
/// does not break: volume over that of the cap of the whole overlap [-].
double volume_share(const dem::SolidMaterial &other)
{
  dem::EngineParameters p = press_parameters();
  p.breakage.share = dem::EnergyShare::compliance;
  p.other_solids = {other};
  dem::Engine engine(p);
  for (const std::uint8_t material : {0, 1})
  {
    const double side = material == 0 ? -1. : 1.;
    engine.add_particle(particle(ellipsoid()), {side * axes.x(), 0., 0.},
                        dem::Quaternion::Identity(), material);
    engine.particles().last().velocity.x() = -side * 10.;
  }
  while (engine.n_events() == 0 && engine.time() < 1e-3)
    engine.advance(2e-8);
  const auto events = engine.take_events();
  if (events.empty())
    return 0.;
  const double overlap = events[0].overlap;
  return events[0].removed_volume /
         (std::numbers::pi * tip_radius() * overlap * overlap);
}
} // namespace

// delta_i = w_i delta, w_i by (1 - nu) / G: V_i goes with the square.
TEST(EngineBreakage, SharesAreByCompliance)
{
  const dem::ParticleMaterial rock;
  const double own = (1. - rock.poisson_ratio) / rock.shear_modulus;
  for (const double stiffer : {1., 10.})
  {
    const dem::SolidMaterial other{2700., stiffer * rock.shear_modulus, 0.3};
    const double its = (1. - other.poisson_ratio) / other.shear_modulus;
    const double share = own / (own + its);
    EXPECT_NEAR(volume_share(other), share * share, 1e-4);
  }
}

namespace
{
/// Forces of the first event on the tips of a particle that stands on facets
/// under a plate, by the kind of the other side, if breaking is switched on
/// under half of the force of an event [N].
std::map<int, double> first_events_when_switched_on(const std::string &law)
{
  dem::EngineParameters p = press_parameters();
  p.breakage.is_active = false;
  p.wall.law = law;
  p.surface = p.wall;
  dem::Engine engine(p);
  engine.add_particle(
      particle(ellipsoid()), dem::Vec3(0., 0., axes.x()),
      dem::Quaternion::FromTwoVectors(dem::Vec3::UnitX(), dem::Vec3::UnitZ()));
  dem::add_plane(engine, {0., 0., 2. * axes.x()}, -dem::Vec3::UnitZ());
  dem::attach_surface(engine, support::coplanar_fan(4, 0.02, 0.3));
  dem::planes(engine)[0].velocity.z() =
      law == "linear" ? -2. * slow : -20. * slow;
  const double time_step =
      0.05 * std::sqrt(engine.particles().mass(0) / p.wall.normal_stiffness);
  while (dem::planes(engine)[0].force.z() < 0.5 * first_event() &&
         engine.time() < 0.02)
    engine.advance(time_step);
  engine.set_breaking(true);
  std::map<int, double> forces;
  while (forces.size() < 2 && engine.time() < 0.02)
  {
    engine.advance(time_step);
    for (const dem::BreakageEvent &event : engine.take_events())
      forces.try_emplace(event.kind, event.force_before);
  }
  return forces;
}
} // namespace

// What is stored by then has counted, on facets as on planes: with a linear
// wall, in which the factor grows with the force, one force of an event more.
TEST(EngineBreakage, SwitchedOnUnderLoadCountsWhatComes)
{
  for (const std::string law : {"linear", "hertz"})
  {
    const std::map<int, double> forces = first_events_when_switched_on(law);
    ASSERT_TRUE(forces.contains(1) && forces.contains(2));
    EXPECT_NEAR(forces.at(2), forces.at(1), 0.02 * forces.at(1));
    if (law == "linear")
    {
      EXPECT_NEAR(forces.at(1), 1.5 * first_event(), 0.03 * first_event());
    }
  }
}
