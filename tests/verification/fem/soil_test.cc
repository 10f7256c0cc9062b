#include "solid_scene.h"

#include <fem/condensed.h>

#include <gtest/gtest.h>

#include <numbers>
#include <sstream>

namespace
{
using Vector = Eigen::Vector3d;

constexpr double c = 20e3, phi = 0.5; // [Pa], [rad]

fem::SolidLayer soil(double psi = phi)
{
  return {.youngs_modulus = 40e6,
          .poisson_ratio = 0.3,
          .density = 1800.,
          .cohesion = c,
          .friction_angle = phi,
          .dilatancy_angle = psi};
}

fem::Solid body(const fem::SolidLayer &layer, const fem::SolidMesh &mesh,
                double stiffness_damping = 0.)
{
  fem::SolidParameters p;
  p.layers = {layer};
  p.stiffness_damping = stiffness_damping;
  return fem::Solid(p, mesh);
}

/// A corner of a sample between smooth platens.
void hold_corner(fem::Solid &solid)
{
  solid.fix(fem::x_lower, {true, false, false});
  solid.fix(fem::y_lower, {false, true, false});
  solid.fix(fem::z_lower, {false, false, true});
  solid.fix(fem::z_upper, {false, false, true});
}

void press(fem::Solid &solid, double strain)
{
  for (const std::int32_t node :
       fem::boundary_nodes(solid.mesh(), fem::z_upper))
    solid.set_support_displacement(node, Vector(0., 0., -strain));
}

double pressed(const fem::Solid &solid)
{
  double sum = 0.;
  for (const std::int32_t node :
       fem::boundary_nodes(solid.mesh(), fem::z_upper))
    sum += solid.reaction(node).z();
  return sum;
}

/// Pressure on the sides [N].
support::Vectors confine(const fem::SolidMesh &mesh, double pressure)
{
  auto loads = fem::traction_loads(mesh, fem::x_upper,
                                   [&](const Vector &)
                                   { return Vector(-pressure, 0., 0.); });
  const auto others = fem::traction_loads(
      mesh, fem::y_upper,
      [&](const Vector &) { return Vector(0., -pressure, 0.); });
  for (std::size_t k = 0; k < loads.size(); ++k)
    loads[k] += others[k];
  return loads;
}

double triaxial_strength(double pressure)
{
  return (pressure * (1. + std::sin(phi)) + 2. * c * std::cos(phi)) /
         (1. - std::sin(phi));
}

// A unit cube between platens: the load that it bears is that of Mohr and
// Coulomb, with and without associated flow; the flow widens it as psi says.
TEST(Soil, TriaxialStrengthAndDilatancy)
{
  const fem::SolidMesh mesh = support::box({1., 1., 1.}, {2, 2, 2});
  for (const double psi : {phi, 0.2})
    for (const double pressure : {0., 50e3})
    {
      fem::Solid solid = body(soil(psi), mesh);
      hold_corner(solid);
      const auto loads = confine(mesh, pressure);
      solid.settle(loads);
      for (int k = 1; k <= 12; ++k)
      {
        press(solid, 1e-3 * k);
        solid.settle(loads);
      }
      const double exact = triaxial_strength(pressure);
      EXPECT_NEAR(pressed(solid), exact, 1e-6 * exact);
      const auto far =
          static_cast<std::size_t>(support::node_at(mesh, Vector(1., 1., 1.)));
      const Vector before = solid.displacements()[far];
      press(solid, 13e-3);
      solid.settle(loads);
      const Vector flow = solid.displacements()[far] - before;
      // d eps_v / d eps_1 = -2 sin psi / (1 - sin psi) in compression.
      const double share = flow.sum() / -flow.z();
      EXPECT_NEAR(share, 2. * std::sin(psi) / (1. - std::sin(psi)), 1e-6);
    }
}

// The pressure of the ground around, as an initial stress, strengthens as the
// same pressure on the sides does; what is pressed counts from it.
TEST(Soil, InitialStressCountsForTheStrength)
{
  const fem::SolidMesh mesh = support::box({1., 1., 1.}, {2, 2, 2});
  fem::Solid solid = body(soil(0.2), mesh);
  hold_corner(solid);
  const double pressure = 50e3;
  solid.set_initial_stress(
      [&](const Vector &)
      {
        fem::Voigt stress = fem::Voigt::Zero();
        stress.head<3>().setConstant(-pressure);
        return stress;
      });
  for (int k = 1; k <= 12; ++k)
  {
    press(solid, 1e-3 * k);
    solid.settle(support::no_loads(solid));
  }
  const double exact = triaxial_strength(pressure) - pressure;
  EXPECT_NEAR(pressed(solid), exact, 1e-6 * exact);
  EXPECT_NEAR(-solid.stress(3)[2], exact, 1e-6 * exact);
  EXPECT_NEAR(support::balance(solid.energy()), 0.,
              1e-9 * solid.energy().plastic);
}

// Work is stored or dissipated, to round-off, in steps of any size.
TEST(Soil, EnergyOfEquilibriumBalances)
{
  const fem::SolidMesh mesh = support::box({1., 1., 1.}, {3, 3, 3});
  fem::Solid solid = body(soil(0.2), mesh);
  hold_corner(solid);
  solid.fix(fem::z_upper, {true, true, true}); // rough: not uniform
  const auto loads = confine(mesh, 20e3);
  solid.settle(loads);
  for (const double strain : {1e-3, 3e-3, 8e-3, 7e-3, 5e-3})
  {
    press(solid, strain);
    solid.settle(loads);
  }
  const fem::SolidEnergy e = solid.energy();
  EXPECT_GT(e.plastic, 5. * e.strain);
  EXPECT_NEAR(support::balance(e), 0., 1e-9 * e.plastic);
}

// The consistent tangent: every iteration squares what is left.
TEST(Soil, NewtonIsQuadratic)
{
  const fem::SolidMesh mesh = support::box({1., 1., 1.}, {3, 3, 3});
  for (const double psi : {phi, 0.2})
  {
    fem::Solid solid = body(soil(psi), mesh);
    hold_corner(solid);
    solid.fix(fem::z_upper, {true, true, true});
    press(solid, 2.5e-3);
    solid.settle(support::no_loads(solid));
    const auto left = solid.newton_residuals();
    for (const double one : left)
      std::printf(" %.1e", one);
    std::printf("\n");
    ASSERT_GE(left.size(), 4u);
    EXPECT_LT(left.size(), 12u);
    // The last two iterations above round-off: exponent near two.
    std::size_t last = 0;
    while (last + 1 < left.size() && left[last + 1] > 1e-12)
      ++last;
    ASSERT_GE(last, 2u);
    const double order = std::log(left[last] / left[last - 1]) /
                         std::log(left[last - 1] / left[last - 2]);
    EXPECT_GT(order, 1.6);
  }
}

TEST(Soil, BelowYieldItIsElastic)
{
  const fem::SolidMesh mesh = support::box({1., 1., 1.}, {2, 2, 2});
  fem::Solid solid = body(soil(), mesh);
  hold_corner(solid);
  const double strain = 0.99 * triaxial_strength(0.) / 40e6;
  press(solid, strain);
  solid.settle(support::no_loads(solid));
  EXPECT_EQ(solid.energy().plastic, 0.);
  EXPECT_TRUE(solid.newton_residuals().empty());
  EXPECT_NEAR(pressed(solid), 40e6 * strain, 1e-6 * 40e6 * strain);
}

TEST(Soil, TooHeavyALoadIsRefused)
{
  const fem::SolidMesh mesh = support::box({1., 1., 1.}, {1, 1, 1});
  fem::Solid solid = body(soil(), mesh);
  solid.fix(fem::x_lower, {true, false, false});
  solid.fix(fem::y_lower, {false, true, false});
  solid.fix(fem::z_lower, {false, false, true});
  const auto load = [&](double share)
  {
    return fem::traction_loads(
        mesh, fem::z_upper,
        [&](const Vector &)
        { return Vector(0., 0., -share * triaxial_strength(0.)); });
  };
  solid.settle(load(0.999));
  EXPECT_THROW(solid.settle(load(1.01)), std::runtime_error);
}

// Slow explicit and implicit motion reach the same strength; the balance
// closes in the order of the step, or to what Newton's method leaves.
TEST(Soil, MotionReachesTheStrengthAndBalances)
{
  const fem::SolidMesh mesh = support::box({1., 1., 1.}, {2, 2, 2});
  for (const bool is_implicit : {false, true})
  {
    fem::Solid solid = body(soil(0.2), mesh, 3e-4);
    hold_corner(solid);
    const double limit = solid.stable_time_step().time_step;
    const double step = is_implicit ? 1e-3 : 0.5 * limit, speed = 0.01;
    for (const std::int32_t node : fem::boundary_nodes(mesh, fem::z_upper))
      solid.set_support_velocity(node, Vector(0., 0., -speed));
    for (double time = 0.; time < 0.4; time += step)
      if (is_implicit)
        solid.advance(support::no_loads(solid), step);
      else
      {
        solid.begin_step(step);
        solid.end_step(support::no_loads(solid), step);
      }
    const double exact = triaxial_strength(0.);
    double mean = 0.;
    for (std::size_t k = 0; k < mesh.cells.size(); ++k)
      mean -= solid.stress(k)[2] / static_cast<double>(mesh.cells.size());
    // The viscous stress is beside it.
    EXPECT_NEAR(mean, exact, 8e-3 * exact);
    const fem::SolidEnergy e = solid.energy();
    std::printf("strength %.5f of exact, balance %.1e of what is dissipated\n",
                mean / exact, support::balance(e) / e.plastic);
    EXPECT_NEAR(support::balance(e), 0.,
                (is_implicit ? 1e-8 : 1e-3) * e.plastic);
  }
}

TEST(Soil, CheckpointCarriesTheFlow)
{
  const fem::SolidMesh mesh = support::box({1., 1., 1.}, {2, 2, 2});
  const auto scene = [&]
  {
    fem::Solid solid = body(soil(0.2), mesh);
    hold_corner(solid);
    return solid;
  };
  fem::Solid first = scene();
  press(first, 5e-3);
  first.settle(support::no_loads(first));
  std::stringstream file;
  first.save(file);
  fem::Solid second = scene();
  second.load(file);
  for (fem::Solid *one : {&first, &second})
  {
    press(*one, 4e-3);
    one->settle(support::no_loads(*one));
  }
  EXPECT_EQ(pressed(first), pressed(second));
  EXPECT_EQ(first.energy().plastic, second.energy().plastic);
}

TEST(Soil, WrongLayersAreRefused)
{
  const fem::SolidMesh mesh = support::box({1., 1., 1.}, {1, 1, 1});
  fem::SolidLayer layer = soil();
  layer.friction_angle = 2.;
  EXPECT_THROW(body(layer, mesh), std::invalid_argument);
  layer = soil();
  layer.dilatancy_angle = 0.6;
  EXPECT_THROW(body(layer, mesh), std::invalid_argument);
  layer = soil();
  layer.cohesion = -1.;
  EXPECT_THROW(body(layer, mesh), std::invalid_argument);
  fem::Solid good = body(soil(), mesh);
  good.fix(fem::z_lower, {true, true, true});
  EXPECT_THROW(fem::CondensedSolid(good, {.interface = fem::boundary_nodes(
                                              mesh, fem::z_upper)}),
               std::invalid_argument);
}

/// Smooth strip footing of half width 1 on a plane-strain block 5 wide and 3
/// deep, one half of it, under an initial pressure all over; mean pressure
/// under it beyond that when it has sunk in [Pa].
double strip_pressure(int n, const fem::SolidLayer &layer, double surcharge)
{
  fem::BoxMesh box;
  box.lower = {0., 0., -3.};
  const auto half = static_cast<std::size_t>(n);
  box.widths[0].assign(half, 1. / n);
  for (const double width : fem::graded_widths(1. / n, 1.15, 4.))
    box.widths[0].push_back(width);
  box.widths[1] = {1. / n};
  const auto down = fem::graded_widths(1. / n, 1.1, 3.);
  box.widths[2].assign(down.rbegin(), down.rend());
  const fem::SolidMesh mesh = fem::box_mesh(box);
  fem::Solid solid = body(layer, mesh);
  solid.set_initial_stress(
      [&](const Vector &)
      {
        fem::Voigt stress = fem::Voigt::Zero();
        stress.head<3>().setConstant(-surcharge);
        return stress;
      });
  solid.fix(fem::x_lower, {true, false, false});
  solid.fix(fem::x_upper, {true, false, false});
  solid.fix(fem::y_lower, {false, true, false});
  solid.fix(fem::y_upper, {false, true, false});
  solid.fix(fem::z_lower, {true, true, true});
  std::vector<std::int32_t> under;
  for (const std::int32_t node : fem::boundary_nodes(mesh, fem::z_upper))
    if (mesh.nodes[static_cast<std::size_t>(node)].x() < 1. + 1e-9)
    {
      under.push_back(node);
      solid.fix_node(node, {false, false, true});
    }
  double pressure = 0.;
  for (const double sunk : {2e-3, 4e-3, 8e-3, 14e-3, 20e-3})
  {
    for (const std::int32_t node : under)
      solid.set_support_displacement(node, Vector(0., 0., -sunk));
    solid.settle(support::no_loads(solid));
    pressure = 0.;
    for (const std::int32_t node : under)
      pressure += solid.reaction(node).z();
    pressure *= n; // the block is 1 / n thick
    std::printf("n %d, sunk %.3f: %.4f c, %zu iterations\n", n, sunk,
                pressure / c, solid.newton_residuals().size());
  }
  return pressure;
}

// Prandtl (1920): 2 + pi on clay without weight. Cells at the edge of the
// footing smear the fan over their width: from above, in first order.
TEST(Soil, StripFootingBearsWhatPrandtlSays)
{
  fem::SolidLayer clay = soil();
  clay.friction_angle = clay.dilatancy_angle = 0.;
  const double k = 2. * c / std::sqrt(3.); // plane strain: sqrt(J2) = k
  const double exact = (2. + std::numbers::pi) * k;
  const double coarse = strip_pressure(4, clay, 0.) / exact;
  const double fine = strip_pressure(8, clay, 0.) / exact;
  EXPECT_LT(fine - 1., 0.08);
  EXPECT_GT(fine, 1.);
  EXPECT_LT(fine, coarse);
  EXPECT_NEAR(2. * fine - coarse, 1., 0.03);
}

/// The layer whose cone is Mohr and Coulomb's of c and this angle in plane
/// strain with associated flow: eta = 3 tan / sqrt(9 + 12 tan^2), k = 3 c /
/// sqrt(9 + 12 tan^2) (Drucker and Prager 1952).
fem::SolidLayer plane_strain_soil(double angle)
{
  const double root = std::sqrt(9. + 12. * std::pow(std::tan(angle), 2));
  const double eta = 3. * std::tan(angle) / root;
  const double sine =
      3. * std::sqrt(3.) * eta / (6. + std::sqrt(3.) * eta); // in compression
  fem::SolidLayer layer = soil();
  layer.friction_angle = layer.dilatancy_angle = std::asin(sine);
  layer.cohesion = 3. * c / root * std::sqrt(3.) * (3. - sine) /
                   (6. * std::cos(layer.friction_angle));
  return layer;
}

// With friction, Prandtl (1920) and Reissner (1924): without weight it bears c
// Nc + q Nq, Nq = tan^2(pi / 4 + phi / 2) e^(pi tan phi), Nc = (Nq - 1) cot
// phi. The surcharge q is an initial stress.
TEST(Soil, StripFootingOnFrictionAndSurcharge)
{
  const double angle = 10. * std::numbers::pi / 180.;
  const double tan = std::tan(angle);
  const double n_q =
      std::pow(std::tan(0.25 * std::numbers::pi + 0.5 * angle), 2) *
      std::exp(std::numbers::pi * tan);
  const fem::SolidLayer layer = plane_strain_soil(angle);
  for (const double surcharge : {0., 20e3})
  {
    const double exact = c * (n_q - 1.) / tan + surcharge * n_q - surcharge;
    const double coarse = strip_pressure(4, layer, surcharge) / exact;
    const double fine = strip_pressure(8, layer, surcharge) / exact;
    std::printf("q %g: of exact %.4f %.4f, to the limit %.4f\n", surcharge,
                coarse, fine, 2. * fine - coarse);
    EXPECT_GT(fine, 1.);
    EXPECT_LT(fine, coarse);
    EXPECT_NEAR(2. * fine - coarse, 1., 0.03);
  }
}
} // namespace
