#include "run/step_watch.h"

#include <gtest/gtest.h>

#include <dem_scene.h>

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
  engine.add_plane(dem::Vec3::Zero(), dem::Vec3::UnitZ());
  engine.particles().velocity(0) = {0., 0., -speed};
  engine.advance(step);
  TimeParameters time;
  time.step = StepRule::stable;
  constexpr double cap = 1.;
  for (const int stone_steps : {1, 5})
  {
    StepWatch watch(time, cap);
    Surroundings around;
    around.stone_steps = stone_steps;
    watch.look(engine, around, step);
    if (stone_steps == 1)
      EXPECT_EQ(watch.state().limit, cap);
    else
      EXPECT_LT(watch.state().limit, 1e-3 * cap);
  }
}
} // namespace
