// Rims that are held along some axes and slide along the others: a sheet under
// uniaxial tension whose width is free, against the closed forms of both laws.
#include "flat_mesh.h"
#include "relax.h"

#include <gtest/gtest.h>

#include <cmath>
#include <sstream>

namespace
{
using Vector = Eigen::Vector3d;

constexpr double side = 0.2, stretch = 1.2;
constexpr int n = 6;

fem::MembraneParameters sheet_of(fem::MembraneLaw law)
{
  fem::MembraneParameters p;
  p.law = law;
  if (law == fem::MembraneLaw::neo_hooke)
    p.poisson_ratio = 0.5;
  return p;
}

/// What is left across a sheet that is stretched along x alone, and the force
/// that pulls it, over the sides that are not stretched.
struct Uniaxial
{
  double width = 0.; ///< [-]
  double force = 0.; ///< [N/m]
};

/// St Venant-Kirchhoff, S = E E_11, E_22 = -nu E_11; incompressible neo-Hooke,
/// lambda_2 = lambda^(-1/2), P = mu (lambda - lambda^-2).
Uniaxial exact(const fem::MembraneParameters &p)
{
  const double strain = 0.5 * (stretch * stretch - 1.),
               modulus = p.youngs_modulus * p.thickness;
  if (p.law == fem::MembraneLaw::st_venant_kirchhoff)
    return {std::sqrt(1. - 2. * p.poisson_ratio * strain),
            modulus * strain * stretch};
  return {1. / std::sqrt(stretch),
          modulus / 3. * (stretch - 1. / (stretch * stretch))};
}

std::vector<std::int32_t> column(int i)
{
  std::vector<std::int32_t> nodes;
  for (std::int32_t j = 0; j <= n; ++j)
    nodes.push_back(j * (n + 1) + i);
  return nodes;
}

/// A square with inner nodes off the lattice; its rims x = 0 and x = side are
/// held along x and z and slide along y, but for a node in the middle of each.
struct Strip
{
  explicit Strip(const fem::MembraneParameters &p) : membrane(p, mesh())
  {
    for (const int i : {0, n})
    {
      membrane.tie(column(i), {true, false, true});
      membrane.tie({column(i)[n / 2]}, {false, true, false});
    }
  }

  static fem::SurfaceMesh mesh()
  {
    fem::SurfaceMesh square = support::flat_square(side, n);
    for (int j = 1; j < n; ++j)
      for (int i = 1; i < n; ++i)
        square.nodes[std::size_t(j * (n + 1) + i)] +=
            0.2 * side / n * Vector(std::sin(3. * i + j), std::cos(2. * j), 0.);
    return square;
  }

  void pull(double velocity)
  {
    for (const std::int32_t node : column(n))
      membrane.set_tied_velocity(node, {velocity, 7., 0.});
    // Along y the middle is tied: it stays.
    membrane.set_tied_velocity(column(n)[n / 2], {velocity, 0., 0.});
  }

  double width(int i) const
  {
    const auto x = membrane.positions();
    return x[std::size_t(column(i)[n])].y() - x[std::size_t(column(i)[0])].y();
  }

  Vector pulled_by() const
  {
    Vector sum = Vector::Zero();
    for (const std::int32_t node : column(n))
      sum -= membrane.reaction(node);
    return sum;
  }

  void expect_closed_form(const fem::MembraneParameters &p,
                          double tolerance) const
  {
    const Uniaxial known = exact(p);
    for (int i = 0; i <= n; ++i)
      EXPECT_NEAR(width(i), side * known.width, tolerance * side) << i;
    const double force = side * known.force;
    EXPECT_NEAR(pulled_by().x(), force, tolerance * force);
    EXPECT_NEAR(pulled_by().y(), 0., tolerance * force);
    // Stress along x alone: volume of the sheet times its Cauchy stress.
    const Eigen::Matrix3d stress = membrane.stress_integral();
    const double along = force * stretch * side;
    EXPECT_NEAR(stress(0, 0), along, tolerance * along);
    EXPECT_NEAR(stress(1, 1), 0., tolerance * along);
    EXPECT_NEAR(stress(0, 1), 0., tolerance * along);
  }

  fem::Membrane membrane;
};

/// Steps that grow tenfold without any memory of fast modes: equilibrium.
void come_to_rest(fem::Membrane &membrane,
                  const fem::NodeSprings *springs = nullptr)
{
  const support::Loads loads(membrane.n_nodes(), Vector::Zero());
  for (double dt = 1e-3; dt < 2e3; dt *= 10.)
    for (int k = 0; k < 4; ++k)
      membrane.advance(loads, dt, fem::generalised_alpha(0.), springs);
}

constexpr std::array<fem::MembraneLaw, 2> laws{
    fem::MembraneLaw::st_venant_kirchhoff, fem::MembraneLaw::neo_hooke};
} // namespace

TEST(SlidingRim, TakesTheWidthOfUniaxialTension)
{
  for (const fem::MembraneLaw law : laws)
  {
    const fem::MembraneParameters p = sheet_of(law);
    Strip strip(p);
    const support::Loads loads(strip.membrane.n_nodes(), Vector::Zero());
    strip.pull((stretch - 1.) * side / 0.02);
    for (int k = 0; k < 20; ++k)
      strip.membrane.advance(loads, 1e-3, fem::generalised_alpha(0.));
    strip.pull(0.);
    come_to_rest(strip.membrane);
    strip.expect_closed_form(p, 1e-8);
    EXPECT_LT(strip.membrane.unbalanced_force_ratio(), 1e-8);
  }
}

// Explicit steps at 0.9 of the stable one reach the same, and all energy is
// accounted for on the way.
TEST(SlidingRim, ExplicitStepsReachTheSame)
{
  for (const fem::MembraneLaw law : laws)
  {
    fem::MembraneParameters p = sheet_of(law);
    p.mass_damping = 300.;
    Strip strip(p);
    const double dt = 0.5 * strip.membrane.stable_time_step();
    const double pulling = std::ceil(0.02 / dt) * dt;
    strip.pull((stretch - 1.) * side / pulling);
    support::advance(strip.membrane, {dt, pulling});
    strip.pull(0.);
    support::advance(strip.membrane, {dt, 0.2});
    strip.expect_closed_form(p, 1e-6);
    const fem::MembraneEnergy e = strip.membrane.energy();
    EXPECT_NEAR(e.strain + e.kinetic + e.damping, e.tie_work,
                1e-4 * e.tie_work);
  }
}

// What moves along y alone has the stable step of that motion: ties that are
// added one axis at a time are those of one call.
TEST(SlidingRim, AxesAddUp)
{
  fem::MembraneParameters p;
  p.tension = 100.;
  fem::Membrane at_once(p, Strip::mesh()), in_turn(p, Strip::mesh());
  at_once.tie(column(0));
  for (const fem::TiedAxes &axes :
       {fem::TiedAxes{true, false, false}, fem::TiedAxes{false, true, false},
        fem::TiedAxes{false, false, true}})
  {
    EXPECT_FALSE(in_turn.is_tied(column(0)[1]));
    in_turn.tie(column(0), axes);
  }
  EXPECT_TRUE(in_turn.is_tied(column(0)[1]));
  EXPECT_EQ(in_turn.stable_time_step(), at_once.stable_time_step());
  std::ostringstream one, other;
  at_once.save(one);
  in_turn.save(other);
  EXPECT_EQ(one.str(), other.str());
}

TEST(SlidingRim, GoesOnFromACheckpoint)
{
  const fem::MembraneParameters p;
  Strip strip(p), resumed(p);
  strip.pull(1.);
  support::advance(strip.membrane, {1e-5, 1e-3});
  std::stringstream state;
  strip.membrane.save(state);
  resumed.membrane.load(state);
  EXPECT_EQ(resumed.membrane.tied_axes(column(n)[0]),
            (fem::TiedAxes{true, false, true}));
  for (Strip *one : {&strip, &resumed})
    support::advance(one->membrane, {1e-5, 1e-3});
  for (std::size_t k = 0; k < strip.membrane.n_nodes(); ++k)
    EXPECT_EQ(strip.membrane.positions()[k], resumed.membrane.positions()[k]);
}

// Springs so stiff that they are supports: the last digit of a position is more
// force than the sheet is balanced to without them.
TEST(SlidingRim, StiffSpringsHoldAsTiesDo)
{
  const fem::MembraneParameters p;
  fem::Membrane membrane(p, Strip::mesh());
  const double spring = 1e9;
  fem::NodeSprings springs{
      std::vector<Eigen::Matrix3d>(membrane.n_nodes(), Eigen::Matrix3d::Zero()),
      std::vector<Vector>(membrane.mesh().nodes)};
  for (const int i : {0, n})
    for (const std::int32_t node : column(i))
    {
      const auto k = static_cast<std::size_t>(node);
      springs.stiffness[k].diagonal() << spring, 0., spring;
      if (node == column(i)[n / 2])
        springs.stiffness[k](1, 1) = spring;
      if (i == n)
        springs.rest[k].x() = stretch * side;
    }
  come_to_rest(membrane, &springs);
  const Uniaxial known = exact(p);
  const auto x = membrane.positions();
  EXPECT_NEAR(x[std::size_t(column(0)[n])].y() -
                  x[std::size_t(column(0)[0])].y(),
              side * known.width, 1e-4 * side);
}

// The message names the node and what is wrong, not the step.
TEST(SlidingRim, CompressionIsNamed)
{
  const fem::MembraneParameters p;
  Strip strip(p);
  std::vector<Vector> x = strip.membrane.mesh().nodes;
  for (Vector &node : x)
    node = Vector(0.3 * node.x(), node.y(), 1e-4 * std::sin(900. * node.x()));
  strip.membrane.set_positions(x);
  std::string message;
  try
  {
    come_to_rest(strip.membrane);
  }
  catch (const std::runtime_error &error)
  {
    message = error.what();
  }
  EXPECT_NE(message.find("is in compression"), std::string::npos) << message;
  EXPECT_NE(message.find("node "), std::string::npos) << message;
}
