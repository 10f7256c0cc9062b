#include "coupled_scene.h"

#include <gtest/gtest.h>

#include <compaction/plate.h>

// Plates that tilt and bend, on balls that nothing moves: springs at known
// positions under a body of known mass.
namespace
{
constexpr double gravity = 9.81, ball = 0.01, disc = 0.075; // [m]

spall::Case plate_case(spall::PlateKind form)
{
  spall::Case c = spall::default_case("vibratory_compaction");
  c.container.diameter = 2. * disc;
  c.plate.form = form;
  c.plate.mass = 60.;
  c.plate.seating_time = 1e3; // no exciter here
  c.wall = support::bare_parameters().wall;
  c.wall.normal_stiffness = 1e7;
  c.coupling.exchange = spall::ExchangeChoice::one_pass;
  c.coupling.rules.particle_steps = 1;
  c.coupling.is_body_implicit = true;
  c.coupling.body_steps = 1;
  return c;
}

/// A plate on balls whose tops are at z = 0.
struct Scene
{
  dem::Engine engine;
  coupling::Exchange exchange;
  spall::CompactionPlate plate;

  static dem::EngineParameters settings(const spall::Case &c)
  {
    dem::EngineParameters p = support::bare_parameters();
    p.wall = c.wall;
    p.particle.density = 1e12;
    return p;
  }
  static coupling::ExchangeParameters rules(const spall::Case &c)
  {
    return c.plate.form == spall::PlateKind::elastic
               ? c.coupling.exchange_rules()
               : coupling::ExchangeParameters{};
  }
  static dem::Engine with_balls(const spall::Case &c,
                                const std::vector<dem::Vec3> &positions)
  {
    dem::Engine engine(settings(c));
    for (const dem::Vec3 &position : positions)
      support::add_sphere(engine, ball, position - ball * dem::Vec3::UnitZ());
    return engine;
  }

  Scene(const spall::Case &c, const std::vector<dem::Vec3> &positions,
        double height)
      : engine(with_balls(c, positions)), exchange(rules(c)),
        plate(c, height, 0, exchange, engine)
  {
  }
  void advance(double step)
  {
    exchange.advance(coupling::particles_of(engine, support::no_shapes()),
                     step);
  }
};

/// Two balls at x = far, two at x = -near, none of them on an axis.
constexpr double far = 0.05, near = 0.03, across = 0.03;
const std::vector<dem::Vec3> uneven = {{far, across, 0.},
                                       {far, -across, 0.},
                                       {-near, across, 0.},
                                       {-near, -across, 0.}};

/// Mass, moment of inertia about y, and the centre above the lower face.
struct Mass
{
  double mass = 0., inertia = 0., height = 0.;
};

/// Sinking z and slope p after some time, from z = W / 4 k and p = 0:
/// m z'' = W - k sum (z + p x), I p'' = -k sum x (z + p x) - W (h + r) p:
/// forces stay normal to the plate and pass through the middle of the balls, h
/// + r below its centre.
Eigen::Vector2d rocked(const Mass &body, double stiffness, double time)
{
  const double weight = body.mass * gravity;
  Eigen::Matrix2d springs = Eigen::Matrix2d::Zero();
  for (const dem::Vec3 &position : uneven)
  {
    const Eigen::Vector2d lever(1., position.x());
    springs += stiffness * lever * lever.transpose();
  }
  springs(1, 1) += weight * (body.height + ball);
  const Eigen::Matrix2d mass =
      Eigen::Vector2d(body.mass, body.inertia).asDiagonal();
  const Eigen::Vector2d rest = springs.inverse() * Eigen::Vector2d(weight, 0.);
  const Eigen::Vector2d start(weight / (4. * stiffness), 0.);
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::Matrix2d> modes(springs,
                                                                        mass);
  Eigen::Vector2d now =
      modes.eigenvectors().transpose() * mass * (start - rest);
  for (int k = 0; k < 2; ++k)
    now(k) *= std::cos(std::sqrt(modes.eigenvalues()(k)) * time);
  return rest + modes.eigenvectors() * now;
}

/// Largest departure from the closed form over a tenth of a second, ten swings
/// and more, over the largest sinking and slope. The plate
/// does not feel the balls in its first half step, 0.4 %.
Eigen::Vector2d rocking_error(const spall::Case &c, const Mass &body,
                              double step)
{
  const double stiffness = c.wall.normal_stiffness;
  Scene scene(c, uneven, -body.mass * gravity / (4. * stiffness));
  scene.plate.release(0.);
  Eigen::Vector2d worst = Eigen::Vector2d::Zero(), largest = worst;
  while (scene.engine.time() < 0.1)
  {
    scene.advance(step);
    const Eigen::Vector2d exact = rocked(body, stiffness, scene.engine.time());
    const Eigen::Vector2d found(-scene.plate.height(), scene.plate.tilt());
    worst = worst.cwiseMax((found - exact.cwiseAbs()).cwiseAbs());
    largest = largest.cwiseMax(exact.cwiseAbs());
  }
  return worst.cwiseQuotient(largest);
}
} // namespace

// The phase of 1 % of stiffness, mass or inertia is 0.3 rad by the end.
TEST(TiltingPlate, RocksOnOffCentreSprings)
{
  const spall::Case c = plate_case(spall::PlateKind::tilting);
  const Mass body{c.plate.mass,
                  fem::disc_inertia(c.plate.mass, disc, c.plate.height).y(),
                  0.5 * c.plate.height};
  const Eigen::Vector2d error = rocking_error(c, body, 5e-6);
  std::printf("sinking %.2e, tilt %.2e\n", error.x(), error.y());
  EXPECT_LT(error.maxCoeff(), 2e-2);
}

// A hundred times as stiff as steel: its mass on four springs round its axis,
// from where it touches them, z = W / 4 k (1 - cos sqrt(4 k / m) t).
TEST(ElasticPlate, IsRigidWhenItIsStiff)
{
  spall::Case c = plate_case(spall::PlateKind::elastic);
  c.plate.youngs_modulus = 2e13;
  c.plate.elements = 3;
  Scene scene(c, {{far, 0., 0.}, {-far, 0., 0.}, {0., far, 0.}, {0., -far, 0.}},
              0.);
  scene.plate.release(0.);
  const double springs = 4. * c.wall.normal_stiffness;
  const double sinking = c.plate.mass * gravity / springs,
               omega = std::sqrt(springs / c.plate.mass);
  double worst = 0.;
  while (scene.engine.time() < 0.04)
  {
    scene.advance(1e-5);
    const double exact = sinking * (1. - std::cos(omega * scene.engine.time()));
    worst = std::max(worst, std::abs(-scene.plate.height() - exact));
  }
  std::printf("sinking %.2e of %.3e m, tilt %.2e\n", worst / sinking, sinking,
              scene.plate.tilt());
  EXPECT_LT(worst, 2e-2 * sinking);
  EXPECT_LT(scene.plate.tilt() * disc, 1e-3 * sinking);
}

namespace
{
/// Middle of a round plate on a rim of this radius under a load spread over a
/// circle (Timoshenko and Woinowsky-Krieger 1959, article 16), and what shear
/// adds.
double sag(const spall::PlateParameters &p, double rim, double load,
           double circle)
{
  const double nu = p.poisson_ratio, shear = p.youngs_modulus / (2. + 2. * nu);
  const double rigidity =
      p.youngs_modulus * std::pow(p.thickness, 3) / (12. * (1. - nu * nu));
  const double within = circle * circle;
  const double bending =
      load / (16. * std::numbers::pi * rigidity) *
      ((3. + nu) / (1. + nu) * rim * rim + within * std::log(circle / rim) -
       (7. + 3. * nu) / (4. * (1. + nu)) * within);
  const double sheared =
      load / (2. * std::numbers::pi * 5. / 6. * shear * p.thickness) *
      (0.5 + std::log(rim / circle));
  return bending + sheared;
}

/// Radius of the circle of as much area as a polygon round a circle.
double circle_of(double radius, double corners)
{
  const double angle = std::numbers::pi / corners;
  return radius * std::sqrt(std::tan(angle) / angle);
}

/// The middle of the lower face below the corners of its rim, which are held,
/// under the weight of what it carries; the closed form beside it [m].
std::array<double, 2> sags(spall::Case c, int elements)
{
  c.plate.elements = elements;
  fem::Solid solid = spall::elastic_plate(c, 0.);
  const auto &nodes = solid.mesh().nodes;
  std::vector<dem::Vec3> load;
  std::size_t middle = 0;
  double n = 0., rim = 0.;
  for (std::size_t k = 0; k < nodes.size(); ++k)
  {
    load.emplace_back(0., 0., -gravity * solid.nodal_mass()[k]);
    const auto number = static_cast<std::int32_t>(k);
    if (std::abs(nodes[k].z()) > 1e-9)
      continue;
    if (nodes[k].norm() < nodes[middle].norm())
      middle = k;
    if (nodes[k].norm() < 0.999 * disc)
      continue;
    ++n;
    rim = nodes[k].norm();
    const bool is_on_x = std::abs(nodes[k].y()) < 1e-9,
               is_on_y = std::abs(nodes[k].x()) < 1e-9;
    solid.fix_node(number, {is_on_y, is_on_x, true}); // free to go outward
  }
  solid.settle(load);
  const double whole = circle_of(disc, n);
  const double own =
      c.plate.density * std::numbers::pi * whole * whole * c.plate.thickness;
  return {-solid.displacements()[middle].z(),
          sag(c.plate, rim, (c.plate.mass - own) * gravity,
              circle_of(c.plate.load_radius, n)) +
              sag(c.plate, rim, own * gravity, whole)};
}
} // namespace

// Cells of displacements are too stiff: 2.8, 1.0 and 0.5 % with 12, 24, 36.
TEST(ElasticPlate, SagsOnItsRim)
{
  spall::Case c = plate_case(spall::PlateKind::elastic);
  c.plate.thickness = 5e-3;
  c.plate.load_radius = 0.03;
  double error = 0.05;
  for (const int elements : {12, 24, 36})
  {
    const auto [found, exact] = sags(c, elements);
    std::printf("%d elements: %.4e of %.4e m, %.4f\n", elements, found, exact,
                found / exact - 1.);
    EXPECT_LT(found, exact);
    EXPECT_LT(1. - found / exact, error);
    error = 0.6 * (1. - found / exact);
  }
  EXPECT_LT(error, 0.6 * 0.008);
}
