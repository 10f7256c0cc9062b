#include <dem/engine_boundaries.h>
#include <dem/integrate/impact.h>

#include <gtest/gtest.h>

#include <dem_scene.h>

namespace
{
using dem::Vec3;
constexpr double radius = 0.01, speed = 1.;

dem::EngineParameters plate_with(double damping)
{
  dem::EngineParameters p = support::bare_parameters();
  p.wall.law = "hertz";
  p.wall.normal_damping = damping;
  return p;
}

/// C_H of the sphere on a rigid plate [N/m^1.5].
double prefactor(const dem::EngineParameters &p)
{
  const double modulus =
      2. * p.particle.shear_modulus / (1. - p.particle.poisson_ratio);
  return 4. / 3. * modulus * std::sqrt(radius);
}

struct Rebound
{
  double error = 0.;    ///< non-conservative work over kinetic energy [-]
  double duration = 0.; ///< steps with a contact times the step [s]
};

/// A sphere on a plate with this step, `gap` above it at first.
Rebound impact_of(double damping, double step, double gap)
{
  dem::Engine engine(plate_with(damping));
  support::add_sphere(engine, radius, {0., 0., radius + gap});
  dem::add_plane(engine, Vec3::Zero(), Vec3::UnitZ());
  engine.particles().velocity(0) = {0., 0., -speed};
  const double kinetic = engine.energy().kinetic;
  Rebound rebound;
  const auto touches = [&engine]
  { return engine.particles().position(0).z() < radius; };
  while (!touches())
    engine.advance(step);
  for (; touches(); engine.advance(step))
    rebound.duration += step;
  engine.advance(step);
  rebound.error = engine.energy().non_conservative_work / kinetic;
  return rebound;
}

// The closed form, which a sampled contact meets within a step.
TEST(HertzImpact, DurationIsThatOfTheClosedForm)
{
  const dem::EngineParameters p = plate_with(0.);
  const double mass = dem::make_sphere(radius).volume * p.particle.density;
  const double expected = dem::impact_duration(prefactor(p), mass, speed);
  const double step = 2e-4 * expected;
  EXPECT_NEAR(impact_of(0., step, 1e-7).duration, expected, step);
}

// For any instant of touch and any dashpot the error is within the bound, and
// the bound is no more than 1.6 times the worst of them.
TEST(HertzImpact, EnergyErrorStaysWithinItsBound)
{
  const dem::EngineParameters p = plate_with(0.);
  const double mass = dem::make_sphere(radius).volume * p.particle.density;
  const double duration = dem::impact_duration(prefactor(p), mass, speed);
  for (const double tolerance : {0.14, 0.05, 0.02, 0.005})
  {
    const double step = duration / dem::steps_of_impact(tolerance);
    double worst = 0.;
    for (const double damping : {0., 0.1, 0.27, 0.62, 0.8})
      for (int phase = 1; phase <= 25; ++phase)
      {
        const double error = std::abs(
            impact_of(damping, step, phase / 25. * step * speed).error);
        EXPECT_LT(error, tolerance) << damping << " " << phase;
        worst = std::max(worst, error);
      }
    EXPECT_GT(worst, tolerance / 1.6);
  }
}
} // namespace
