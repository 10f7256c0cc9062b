#include "test/test.h"

#include <gtest/gtest.h>

#include <functional>

namespace
{
using namespace spall;

/// A few dozen spheres to be poured on a coarse ground.
Case small_case()
{
  Case c;
  c.kind = "subgrade";
  SubgradeParameters &s = c.subgrade;
  s.layer.length = s.layer.width = 0.2;
  s.layer.thickness = 0.06;
  s.layer.shapes = "";
  s.plate.diameter = 0.14;
  s.ground.length = s.ground.width = 0.8;
  s.ground.layers = "0.1 40e6 0.3 1900, 0.4 20e6 0.3 1800";
  s.ground.growth = 1.6;
  s.record.stress_depths = "0.05 0.2";
  c.coupling.exchange = ExchangeChoice::one_pass;
  c.time.fixed_step = 5e-7;
  return c;
}

std::string text_with(const std::function<void(Case &)> &change)
{
  Case c = small_case();
  change(c);
  return make_test(c)->preparation_text();
}

// Held ground counts by the mesh and the masses of its top alone.
TEST(PouredParticles, TextFollowsTheTopOfTheGround)
{
  const std::string before = text_with([](Case &) {});
  const auto ground = [](auto change)
  { return text_with([&](Case &c) { change(c.subgrade.ground); }); };
  EXPECT_EQ(
      ground([](auto &g) { g.layers = "0.1 9e6 0.2 1900, 0.4 20e6 0.3 1700"; }),
      before);
  EXPECT_EQ(ground([](auto &g) { g.bottom = GroundSide::rigid; }), before);
  EXPECT_EQ(ground([](auto &g) { g.mass_damping = 1.; }), before);
  EXPECT_NE(ground([](auto &g)
                   { g.layers = "0.1 40e6 0.3 1800, 0.4 20e6 0.3 1800"; }),
            before);
  EXPECT_NE(ground([](auto &g) { g.cell_size = 0.04; }), before);
  EXPECT_NE(ground([](auto &g) { g.length = 0.81; }), before);
}

TEST(PouredParticles, TextFollowsTheParticlesAndNotTheLoads)
{
  const std::string before = text_with([](Case &) {});
  EXPECT_EQ(text_with(
                [](Case &c)
                {
                  c.subgrade.pulse.amplitude = 1.;
                  c.subgrade.plate.mass = 1.;
                  c.subgrade.record.stress_depths = "";
                  c.coupling.rules.particle_steps = 2;
                }),
            before);
  EXPECT_NE(text_with([](Case &c) { c.subgrade.layer.friction = 0.3; }),
            before);
  EXPECT_NE(text_with(
                [](Case &c) {
                  c.subgrade.layer.gradation = "gradations/quick_7_22mm.csv";
                }),
            before);
  EXPECT_NE(text_with([](Case &c) { c.subgrade.contact.friction = 0.4; }),
            before);
  // The plate makes the mesh below it.
  EXPECT_NE(text_with([](Case &c) { c.subgrade.plate.diameter = 0.12; }),
            before);
}
} // namespace
