#include "coupled_scene.h"
#include "solid_scene.h"

#include <coupling/solid_body.h>

#include <gtest/gtest.h>

#include <cmath>

// Bodies that start from the balance under what lies on them.
namespace
{
constexpr double window = 2e-3;
const fem::SolidLayer soil{20e6, 0.3, 1800.};

fem::Solid block()
{
  fem::SolidParameters p;
  p.layers = {soil};
  p.mass_damping = 400.; // to rest
  fem::Solid solid(p, support::box({0.4, 0.4, 0.2}, {2, 2, 2}));
  support::stand_between_smooth_sides(solid);
  return solid;
}

double settlement(const coupling::DeformableBody &body)
{
  double lowest = 0.;
  for (const dem::Vec3 &at : body.motion().position)
    lowest = std::max(lowest, 0.2 - at.z());
  return lowest;
}

template <class Ground>
void starts_in_balance(Ground &body)
{
  const auto rest = support::pressed(body, 30e3),
             more = support::pressed(body, 40e3);
  body.balance(rest);
  for (int k = 0; k < 10; ++k)
    body.advance(rest, window);
  EXPECT_EQ(settlement(body), 0.);
  const double start = support::missing(body);
  for (int k = 0; k < 400; ++k)
    body.advance(more, window);
  // What exceeds the balance, on a column: q h (1 + nu) (1 - 2 nu) /
  // (E (1 - nu)).
  const double exact = 10e3 * 0.2 * 1.3 * 0.4 / (20e6 * 0.7);
  EXPECT_NEAR(settlement(body), exact, 1e-6 * exact);
  // The particles did the whole of their loads' work on it.
  const double given = 40e3 * 0.16 * exact;
  EXPECT_NEAR(body.energy().load_work, given, 1e-5 * given);
  EXPECT_NEAR(support::missing(body), start, 1e-9 * given);
}
} // namespace

TEST(Balance, FullBodyStartsAtRest)
{
  coupling::SolidBody body(block(), fem::z_upper, {true, 1});
  starts_in_balance(body);
}

TEST(Balance, CondensedBodyStartsAtRest)
{
  coupling::CondensedBody body(block(), fem::z_upper, 6, 1, window);
  starts_in_balance(body);
}
