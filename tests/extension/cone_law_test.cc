#include <dem/contact/law_table.h>

#include <gtest/gtest.h>

#include <cone_law.h>
#include <dem_scene.h>

namespace
{
constexpr double radius = 5e-3, stiffness = 4e9, speed = 0.2;

dem::EngineParameters cone_parameters()
{
  static const bool is_added = (add_cone_law(), true);
  dem::EngineParameters p = support::bare_parameters();
  p.particle.law = is_added ? Cone::name : "";
  p.particle.law_values = {stiffness, 0.8};
  return p;
}
} // namespace

// m* v^2 / 2 = C delta^3 / 3 at the turning point, and all speed comes back:
// for every instruction set.
TEST(ConeLaw, CollisionHasTheClosedForm)
{
  const dem::EngineParameters p = cone_parameters();
  const double reduced =
      0.5 * dem::make_sphere(radius).volume * p.particle.density;
  const double deepest = std::cbrt(1.5 * reduced * speed * speed / stiffness);
  for (int set = 0; set <= int(dem::widest_instruction_set()); ++set)
  {
    dem::use_instruction_set(dem::InstructionSet(set));
    dem::Engine engine(p);
    support::add_sphere(engine, radius, {-radius - 1e-7, 0., 0.});
    support::add_sphere(engine, radius, {radius + 1e-7, 0., 0.});
    engine.particles().velocity(0).x() = 0.5 * speed;
    engine.particles().velocity(1).x() = -0.5 * speed;
    const double step = 1e-3 * deepest / speed;
    double overlap = 0., gap = 0.;
    while (gap < 1e-6)
    {
      engine.advance(step);
      gap = engine.particles().position(1).x() -
            engine.particles().position(0).x() - 2. * radius;
      overlap = std::max(overlap, -gap);
    }
    EXPECT_NEAR(overlap, deepest, 1e-4 * deepest);
    EXPECT_NEAR(engine.particles().velocity(1).x(), 0.5 * speed, 1e-4 * speed);
  }
  dem::use_instruction_set(dem::widest_instruction_set());
}

TEST(ConeLaw, TwoLawsOfOneNameAreRefused)
{
  cone_parameters();
  EXPECT_THROW(add_cone_law(), std::invalid_argument);
}
