#include "coupled_scene.h"
#include "solid_scene.h"

#include <coupling/solid_body.h>

#include <gtest/gtest.h>

#include <cmath>

// Ground that yields, under loads that lie on it and come and go.
namespace
{
using coupling::Field;

constexpr double phi = 0.52, cohesion = 3e3; // [rad], [Pa]

fem::SolidLayer soil(double poisson_ratio = 0.3)
{
  return {.youngs_modulus = 20e6,
          .poisson_ratio = poisson_ratio,
          .density = 1800.,
          .cohesion = cohesion,
          .friction_angle = phi};
}

fem::Solid block(const fem::SolidLayer &layer, double mass_damping)
{
  fem::SolidParameters p;
  p.layers = {layer};
  p.mass_damping = mass_damping;
  return fem::Solid(p, support::box({0.4, 0.4, 0.2}, {2, 2, 2}));
}

/// Level ground at rest under its own weight, its top at z = 0.2 m.
void put_under_weight(fem::Solid &solid)
{
  solid.set_initial_stress(
      [](const Eigen::Vector3d &position)
      {
        const double vertical = -1800. * 9.81 * (0.2 - position.z());
        const double across = (1. - std::sin(phi)) * vertical;
        fem::Voigt stress = fem::Voigt::Zero();
        stress.head<3>() << across, across, vertical;
        return stress;
      });
}

double largest_motion(const coupling::SolidBody &body)
{
  double largest = 0.;
  for (const auto &u : body.solid().displacements())
    largest = std::max(largest, u.norm());
  return largest;
}

// Springs and dashpots of open sides, the stress of the weight and the loads
// that lie on the ground are in balance, though it has flown on the way there.
TEST(Ground, StaysAtRest)
{
  for (const bool is_implicit : {false, true})
    for (const double pressure : {0., 10e3, 40e3})
    {
      fem::Solid solid = block(soil(), 0.);
      for (const auto side : {fem::x_lower, fem::x_upper, fem::y_lower,
                              fem::y_upper, fem::z_lower})
      {
        solid.absorb(side);
        solid.hold_far_field(side, {0.2, 0.2, 0.2});
      }
      put_under_weight(solid);
      coupling::SolidBody body(std::move(solid), fem::z_upper,
                               {is_implicit, is_implicit ? 1 : 20});
      Field rest = support::pressed(body, pressure);
      for (std::size_t k = 0; k < rest.size(); ++k) // and it rubs
        rest[k].x() = k % 2 == 0 ? 0.3 * rest[k].z() : 0.;
      body.balance(rest);
      for (int k = 0; k < 50; ++k)
        body.advance(rest, 2e-4);
      EXPECT_EQ(largest_motion(body), 0.);
      EXPECT_EQ(body.solid().yielded_share(), 0.);
      // More of the same: it has flown when it comes to rest, and goes on.
      for (int k = 0; k < 50; ++k)
        body.advance(support::pressed(body, 1.5 * pressure), 2e-4);
      EXPECT_EQ(body.solid().yielded_share() > 0., pressure > 0.);
    }
}

/// A column between smooth sides.
struct Column
{
  double height = 0.2;
  double area = 0.16;
  coupling::SolidBody body{made(), fem::z_upper, {true, 1}};

  static fem::Solid made()
  {
    fem::Solid solid = block(soil(0.2), 4000.);
    support::stand_between_smooth_sides(solid);
    return solid;
  }

  /// Settlement when it has come to rest under this pressure [m].
  double under(double pressure)
  {
    for (int k = 0; k < 400; ++k)
      body.advance(support::pressed(body, pressure), 2e-3);
    double sum = 0.;
    for (const dem::Vec3 &at : body.motion().position)
      sum += (height - at.z()) / 9.;
    return sum;
  }
};

// No flow across: without dilatancy the volume stays elastic, P = K eps with P
// the mean pressure, and sqrt(J2) = k + eta P on the cone, so that sigma_v = P
// + 2 / sqrt(3) sqrt(J2) grows with K (1 + 2 eta / sqrt(3)) in place of K + 4/3
// G. It begins where 2 / sqrt(3) G eps = k + eta K eps.
TEST(Ground, ColumnSettlesFromTheBalanceAndUnloadsElastically)
{
  const fem::DruckerPrager law = fem::drucker_prager(
      20e6, 0.2, {.cohesion = cohesion, .friction_angle = phi});
  const double bulk = law.bulk_modulus, shear = law.shear_modulus;
  const double elastic = bulk + 4. / 3. * shear;
  const double flowing = bulk * (1. + 2. * law.friction / std::sqrt(3.));
  const double yield =
      law.strength / (2. / std::sqrt(3.) * shear - law.friction * bulk);
  const double first = elastic * yield; // [Pa]
  for (const double rest : {0.5 * first, 1.5 * first})
  {
    Column column;
    column.body.balance(support::pressed(column.body, rest));
    const auto beyond = [&](double pressure)
    {
      return pressure < first ? pressure / elastic
                              : yield + (pressure - first) / flowing;
    };
    const double more = 2. * first;
    const double settled = column.height * (beyond(more) - beyond(rest));
    EXPECT_NEAR(column.under(more), settled, 1e-6 * settled);
    const double left = settled - column.height * (more - rest) / elastic;
    EXPECT_NEAR(column.under(rest), left, 1e-6 * settled);
    EXPECT_GT(left, 1e-2 * settled);
    // All taken off, and back: nothing flows any more.
    const double risen = left - column.height * rest / elastic;
    EXPECT_NEAR(column.under(0.), risen, 1e-6 * settled);
    EXPECT_NEAR(column.under(rest), left, 1e-6 * settled);
    const coupling::BodyEnergy e = column.body.energy();
    EXPECT_NEAR(support::missing(column.body), 0., 1e-6 * e.lost);
    EXPECT_GT(column.body.solid().energy().plastic, 0.);
  }
}

/// A quarter of a square footing, flexible, on level ground under its weight.
struct Footing
{
  static constexpr double side = 1.2, half = 0.3; // [m]
  fem::Solid solid;

  explicit Footing(double its_cohesion) : solid(made(its_cohesion)) {}

  static fem::Solid made(double its_cohesion)
  {
    fem::SolidParameters p;
    p.layers = {soil()};
    p.layers[0].cohesion = its_cohesion;
    fem::Solid solid(p, support::box({side, side, side}, {8, 8, 8}));
    solid.set_initial_stress(
        [](const Eigen::Vector3d &position)
        {
          const double vertical = -1800. * 9.81 * (side - position.z());
          fem::Voigt stress = fem::Voigt::Zero();
          stress.head<3>().setConstant((1. - std::sin(phi)) * vertical);
          stress(2) = vertical;
          return stress;
        });
    support::stand_between_smooth_sides(solid);
    return solid;
  }

  /// Settlement of its middle at rest under this pressure [m].
  double under(double pressure)
  {
    solid.settle(fem::traction_loads(
        solid.mesh(), fem::z_upper,
        [&](const Eigen::Vector3d &at)
        {
          const bool is_below = at.x() < half && at.y() < half;
          return Eigen::Vector3d(0., 0., is_below ? -pressure : 0.);
        }));
    const std::int32_t middle =
        support::node_at(solid.mesh(), Eigen::Vector3d(0., 0., side));
    return -solid.displacements()[static_cast<std::size_t>(middle)].z();
  }
};

// A small load finds it elastic. A larger one leaves it settled, downward, when
// it is taken off; the same again adds little, and work is never got out of the
// flow.
TEST(Ground, FootingLeavesItSettled)
{
  Footing soft(cohesion), elastic(1e9);
  EXPECT_EQ(soft.under(4e3), elastic.under(4e3));
  EXPECT_EQ(soft.solid.energy().plastic, 0.);
  double left = 0., first = 0., dissipated = 0.;
  for (int cycle = 0; cycle < 4; ++cycle)
  {
    const double peak = soft.under(40e3);
    EXPECT_GT(peak, 1.1 * elastic.under(40e3));
    const double more = soft.under(0.) - left;
    std::printf("cycle %d: peak %.4g mm, %.3g mm more left\n", cycle,
                1e3 * peak, 1e3 * more);
    if (cycle == 0)
      first = more;
    EXPECT_GT(first, 0.05 * peak);
    EXPECT_GT(more, -1e-9 * first);
    EXPECT_LE(more, cycle == 0 ? first : 0.2 * first);
    left += more;
    const fem::SolidEnergy e = soft.solid.energy();
    EXPECT_GE(e.plastic, dissipated);
    dissipated = e.plastic;
    EXPECT_NEAR(support::balance(e), 0., 1e-9 * e.plastic);
  }
}
} // namespace
