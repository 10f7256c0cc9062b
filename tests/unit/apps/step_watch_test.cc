#include "errors.h"
#include "run/step_watch.h"

#include <dem/engine_boundaries.h>
#include <dem/measure/contact_springs.h>

#include <gtest/gtest.h>

#include <dem_scene.h>
#include <string>

namespace
{
using namespace spall;

// A ball on its way to a wall that it touches after 500 steps. Looks are 200
// windows apart: it counts if a window has 5 steps, not if it has one.
TEST(StepWatch, SeesAsFarAsTheNextLook)
{
  constexpr double step = 1e-7, speed = 1.;
  dem::Engine engine(support::bare_parameters());
  support::add_sphere(engine, 0.01, {0., 0., 0.01 + 500. * step * speed});
  dem::add_plane(engine, dem::Vec3::Zero(), dem::Vec3::UnitZ());
  engine.particles().velocity(0) = {0., 0., -speed};
  engine.advance(step);
  TimeParameters time;
  time.step = StepRule::stable;
  constexpr double cap = 1.;
  for (const int particle_steps : {1, 5})
  {
    StepWatch watch(time, cap);
    Surroundings around;
    around.particle_steps = particle_steps;
    watch.update(engine, around, step);
    if (particle_steps == 1)
      EXPECT_EQ(watch.state().limit, cap);
    else
      EXPECT_LT(watch.state().limit, 1e-3 * cap);
  }
}

// An undamped ball that falls on the bottom of a drum at rest, again and again:
// each impact is resolved at the speed that comes.
TEST(StepWatch, ResolvesImpacts)
{
  dem::EngineParameters p = support::bare_parameters();
  p.wall.law = "hertz";
  p.gravity = {0., 0., -9.81};
  TimeParameters time;
  time.step = StepRule::stable;
  for (const double tolerance : {0.05, 0.01})
  {
    time.impact_error = tolerance;
    dem::Engine engine(p);
    dem::Drum drum;
    drum.radius = 0.35;
    drum.length = 0.5;
    dem::set_drum(engine, drum);
    constexpr double radius = 0.015, height = 0.05;
    const double floor = radius - drum.radius;
    support::add_sphere(engine, radius, {0., 0., floor + height});
    const double fall = engine.particles().mass(0) * 9.81 * height;
    StepWatch watch(time, 1e-3);
    int n_impacts = 0;
    double before = 0., worst = 0.;
    bool was_up = false;
    while (n_impacts < 5)
    {
      if (watch.is_due(engine.n_steps()))
        watch.update(engine, {}, watch.state().longest);
      engine.advance(watch.state().longest);
      const bool is_up =
          engine.particles().position(0).z() > floor + 0.5 * height;
      if (is_up && !was_up && engine.n_steps() > 1)
      {
        const double now = engine.energy().non_conservative_work;
        worst = std::max(worst, std::abs(now - before) / fall);
        before = now;
        ++n_impacts;
      }
      was_up = is_up;
    }
    EXPECT_LT(worst, tolerance);
    EXPECT_GT(worst, 0.02 * tolerance); // no finer than asked for
  }
}

/// A ball that rests on a wall, and the limit of its step.
struct Resting
{
  dem::Engine engine{support::bare_parameters()};
  double limit = 0.; ///< [s]

  Resting()
  {
    support::add_sphere(engine, 0.01, {0., 0., 0.01 - 1e-6});
    dem::add_plane(engine, dem::Vec3::Zero(), dem::Vec3::UnitZ());
    engine.advance(1e-12);
    limit = dem::sharp_step(dem::contact_springs(engine, 0.));
  }

  /// Where loading begins with a fixed step of so many limits.
  void report(double share, bool is_allowed)
  {
    TimeParameters time;
    time.fixed_step = share * limit;
    time.allow_unstable_step = is_allowed;
    StepWatch watch(time, 1.);
    watch.report(engine, {}, time.fixed_step);
    record = watch.state();
  }
  StepRecord record;
};

TEST(StepWatch, RefusesFixedStepAboveTheSharpLimit)
{
  Resting ball;
  EXPECT_THROW(ball.report(1.01, false), RunFailure);
  EXPECT_NO_THROW(ball.report(0.99, false));
  EXPECT_LT(ball.record.worst_share, 1.);
  EXPECT_NO_THROW(ball.report(1.01, true));
  EXPECT_GT(ball.record.worst_share, 1.);
  try
  {
    ball.report(1.5, false);
  }
  catch (const RunFailure &failure)
  {
    EXPECT_NE(std::string(failure.what()).find("Time/allow_unstable_step"),
              std::string::npos);
  }
}
} // namespace
