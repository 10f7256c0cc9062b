// Contact laws that a scene chooses by name, in the engine.
#include <dem/contact/law_table.h>
#include <dem/engine_boundaries.h>
#include <dem/measure/assembly.h>

#include <gtest/gtest.h>

#include <dem_scene.h>
#include <numbers>
#include <shape/test_shapes.h>

namespace
{
using dem::Vec3;
constexpr double radius = 5e-3;

double mass_of(const dem::EngineParameters &p)
{
  return dem::make_sphere(radius).volume * p.particle.density;
}

/// Two spheres on the x axis with this gap.
dem::Engine two_spheres(const dem::EngineParameters &p, double gap)
{
  dem::Engine engine(p);
  support::add_sphere(engine, radius, {-radius - 0.5 * gap, 0., 0.});
  support::add_sphere(engine, radius, {radius + 0.5 * gap, 0., 0.});
  return engine;
}

/// They move apart with this relative speed.
void part(dem::Engine &engine, double speed)
{
  engine.particles().velocity(0).x() = -0.5 * speed;
  engine.particles().velocity(1).x() = 0.5 * speed;
}

double gap_of(const dem::Engine &engine)
{
  return (engine.particles().position(1) - engine.particles().position(0))
             .norm() -
         2. * radius;
}

constexpr double work_of_adhesion = 0.1, range = 2e-5, step = 1e-7;

dem::EngineParameters adhesive()
{
  dem::EngineParameters p = support::bare_parameters();
  p.particle.law = "dmt";
  p.particle.law_values = {work_of_adhesion, range};
  return p;
}

/// Pull-off force of two of the spheres: R is half of their radius [N].
const double pull_off = std::numbers::pi * radius * work_of_adhesion;

/// Overlap at which Hertz and attraction are in balance [m]: the closed form of
/// two like spheres, E* = G / (1 - nu), C = 4/3 E* sqrt(R).
double balanced_overlap(const dem::EngineParameters &p)
{
  const double modulus =
      p.particle.shear_modulus / (1. - p.particle.poisson_ratio);
  return std::pow(pull_off / (4. / 3. * modulus * std::sqrt(0.5 * radius)),
                  2. / 3.);
}
} // namespace

TEST(ContactLaw, UnknownNameIsRefusedWithTheNames)
{
  dem::EngineParameters p = support::bare_parameters();
  p.particle.law = "hooke";
  try
  {
    two_spheres(p, -1e-6).evaluate(1e-7);
    FAIL();
  }
  catch (const std::invalid_argument &e)
  {
    std::string names;
    for (const dem::ContactLaw &law : dem::contact_laws())
      names += (names.empty() ? "" : ", ") + law.name;
    EXPECT_EQ(std::string(e.what()),
              "contact law hooke: must be one of " + names);
  }
}

// Largest overlap v sqrt(m* / k), duration pi sqrt(m* / k), all speed back.
TEST(ContactLaw, LinearPairsOscillateAsASpring)
{
  dem::EngineParameters p = support::bare_parameters();
  p.particle.law = "linear";
  p.particle.law_values = {2e5, 1e5};
  const double speed = 0.2, reduced = 0.5 * mass_of(p);
  const double period = std::numbers::pi * std::sqrt(reduced / 2e5),
               short_step = period / 500.;
  dem::Engine engine = two_spheres(p, 1e-7);
  part(engine, -speed);
  double deepest = 0., duration = 0.;
  while (gap_of(engine) < 2e-7)
  {
    engine.advance(short_step);
    deepest = std::max(deepest, -gap_of(engine));
    duration += gap_of(engine) < 0. ? short_step : 0.;
  }
  EXPECT_NEAR(deepest, speed * std::sqrt(reduced / 2e5), 1e-4 * deepest);
  EXPECT_NEAR(duration, period, 2. * short_step);
  EXPECT_NEAR(engine.particles().velocity(1).x(), 0.5 * speed, 1e-5 * speed);
}

// Undamped spheres in balance need F0 h / 2 for the range and 3/5 F0 delta for
// the overlap.
TEST(Dmt, SpheresComeApartForTheWorkOfSeparation)
{
  const dem::EngineParameters p = adhesive();
  const double overlap = balanced_overlap(p);
  const double work = pull_off * (0.5 * range + 0.6 * overlap);
  const double reduced = 0.5 * mass_of(p);
  const double speed = std::sqrt(2. * 2. * work / reduced); // twice the work
  dem::Engine engine = two_spheres(p, -overlap);
  engine.advance(step); // the springs are there
  EXPECT_LT(engine.particles().load[0].force.norm(), 1e-6 * pull_off);
  const double at_start = engine.energy().non_conservative_work;
  part(engine, speed);
  while (gap_of(engine) < 2. * range)
    engine.advance(step);
  const double left =
      (engine.particles().velocity(1) - engine.particles().velocity(0)).norm();
  EXPECT_NEAR(0.5 * reduced * left * left, work, 1e-3 * work);
  const dem::EngineEnergy energy = engine.energy();
  EXPECT_NEAR(energy.elastic, 0., 1e-12 * work);
  EXPECT_LT(std::abs(energy.non_conservative_work - at_start), 1e-3 * work);
  EXPECT_EQ(energy.damping, 0.);
}

TEST(Dmt, LessThanTheWorkOfSeparationHolds)
{
  const dem::EngineParameters p = adhesive();
  const double overlap = balanced_overlap(p);
  const double work = pull_off * (0.5 * range + 0.6 * overlap);
  const double reduced = 0.5 * mass_of(p);
  for (const double share : {0.99, 1.01})
  {
    dem::Engine engine = two_spheres(p, -overlap);
    engine.advance(step);
    part(engine, std::sqrt(2. * share * work / reduced));
    double widest = 0.;
    for (int k = 0; k < 100000 && gap_of(engine) < 1.5 * range; ++k)
    {
      engine.advance(step);
      widest = std::max(widest, gap_of(engine));
    }
    EXPECT_EQ(widest > range, share > 1.) << share;
  }
}

// Energy of approach, capture and damping: all of it is booked.
TEST(Dmt, CapturedSpheresLoseWhatTheDashpotTakes)
{
  dem::EngineParameters p = adhesive();
  p.particle.normal_damping = 0.5;
  dem::Engine engine = two_spheres(p, 1.1 * range);
  part(engine, -0.002);
  const double before = engine.energy().kinetic;
  support::advance(engine, 5e-7, 40000);
  const dem::EngineEnergy energy = engine.energy();
  // At rest at the balance: the energy of the bond is gone by the dashpot.
  const double bond = pull_off * (0.5 * range + 0.6 * balanced_overlap(p));
  EXPECT_NEAR(energy.elastic, -bond, 1e-3 * bond);
  EXPECT_NEAR(energy.damping, before + bond, 2e-3 * bond);
  EXPECT_NEAR(energy.kinetic + energy.elastic + energy.damping +
                  energy.non_conservative_work,
              before, 1e-9 * bond);
  EXPECT_NEAR(-gap_of(engine), balanced_overlap(p), 1e-3 * balanced_overlap(p));
}

// From outside of the range in, with lists whose skin is a tenth of it.
TEST(Dmt, ListsSeeAsFarAsItPulls)
{
  dem::EngineParameters p = adhesive();
  p.geometry.skin = 0.1 * range;
  dem::Engine engine = two_spheres(p, 1.5 * range);
  part(engine, -1e-2);
  const double reduced = 0.5 * mass_of(p);
  while (gap_of(engine) > 0.3 * range)
    engine.advance(1e-7);
  // What the attraction has done by then, F0 h (1 - s / h)^2 / 2.
  const double share = 1. - gap_of(engine) / range;
  const double work = 0.5 * pull_off * range * share * share;
  const double speed =
      (engine.particles().velocity(1) - engine.particles().velocity(0)).norm();
  EXPECT_NEAR(0.5 * reduced * (speed * speed - 1e-4), work, 2e-3 * work);
}

// R of a sphere on a plate is its radius.
TEST(Dmt, PlanePullsTwiceAsHard)
{
  dem::EngineParameters p = support::bare_parameters();
  p.wall.law = "dmt";
  p.wall.law_values = {work_of_adhesion, range};
  dem::Engine engine(p);
  support::add_sphere(engine, radius, {0., 0., radius + 0.5 * range});
  dem::add_plane(engine, Vec3::Zero(), Vec3::UnitZ());
  engine.evaluate(1e-9);
  EXPECT_NEAR(engine.particles().load[0].force.z(), -0.5 * 2. * pull_off,
              1e-6 * pull_off);
  EXPECT_NEAR(dem::planes(engine)[0].force.z(), 0.5 * 2. * pull_off,
              1e-6 * pull_off);
}

// Two prolate ellipsoids tip to tip: the radius of curvature is b^2 / a there.
TEST(Dmt, TipsPullByTheirCurvature)
{
  const double long_axis = 6e-3, short_axis = 4.5e-3;
  dem::EngineParameters p = adhesive();
  p.geometry.geometry = dem::ContactGeometry::radial;
  p.geometry.refresh_tolerance = 0.;
  p.breakage.is_active = false;
  const auto series = std::make_shared<const dem::Coefficients>(
      dem::test::project(12,
                         [&](const Vec3 &s)
                         {
                           return dem::test::ellipsoid_radius(
                               {long_axis, short_axis, short_axis}, s);
                         }));
  const double mean = series->front() / std::sqrt(4. * std::numbers::pi);
  const dem::ParticleShape shape = dem::make_shape(series, mean);
  dem::Engine engine(p);
  const double gap = 0.5 * range;
  const double tip = shape.scale * dem::radius(*series, Vec3::UnitX());
  engine.add_particle(shape, {-tip - 0.5 * gap, 0., 0.},
                      dem::Quaternion::Identity());
  engine.add_particle(shape, {tip + 0.5 * gap, 0., 0.},
                      dem::Quaternion(0., 0., 0., 1.));
  engine.evaluate(1e-9);
  const double curvature_radius = short_axis * short_axis / long_axis;
  const double expected =
      0.5 * 2. * std::numbers::pi * 0.5 * curvature_radius * work_of_adhesion;
  // The series of order 12 has the curvature of the tip within some 1e-3.
  EXPECT_NEAR(engine.particles().load[0].force.x(), expected, 5e-3 * expected);
}

TEST(Dmt, TrueSurfacesAreRefused)
{
  dem::EngineParameters p = adhesive();
  p.geometry.geometry = dem::ContactGeometry::surface;
  p.geometry.wall_geometry = dem::ContactGeometry::surface;
  const dem::ParticleShape shape =
      dem::make_shape(std::make_shared<const dem::Coefficients>(
                          dem::test::random_particle(8, 1)),
                      0.01);
  dem::Engine engine(p);
  engine.add_particle(shape, Vec3::Zero(), dem::Quaternion::Identity());
  engine.add_particle(shape, {0.018, 0., 0.}, dem::Quaternion::Identity());
  EXPECT_THROW(engine.evaluate(1e-9), std::invalid_argument);
}
