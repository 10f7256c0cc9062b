#include "laws_cases.h"
#include "scenes.h"

#include <dem/engine_boundaries.h>

#include <algorithm>
#include <cmath>
#include <numbers>

// The laws as the engine evaluates them.
namespace spall::verify
{
namespace
{
/// r = r_0 + c P_2(z), at the pole z = 1 or on the equator.
struct ContactPoint
{
  double bulge = 0.; ///< c / r_0 [-]
  bool is_pole = false;
};

constexpr double base_radius = 0.01; // r_0 [m]

double reach_of(const ContactPoint &contact_point)
{
  return base_radius *
         (1. + (contact_point.is_pole ? 1. : -0.5) * contact_point.bulge);
}

dem::ParticleShape body_at(const ContactPoint &contact_point)
{
  std::vector<double> series = sphere_series(2, base_radius);
  // Y_20 = sqrt(5 / 4 pi) P_2.
  series[std::size_t(dem::harmonic_index(2, 0))] =
      contact_point.bulge * base_radius * std::sqrt(0.8 * std::numbers::pi);
  return body_of(std::move(series));
}

/// Along the meridian (r - r'') / r^2 with r'' = -3 c at the pole and 3 c on
/// the equator; along the equator 1 / r [1/m].
struct Curvatures
{
  double meridian = 0., parallel = 0.;
};

/// As the model regularises them: both at least 1 / (10 r_ins).
Curvatures curvatures_at(const ContactPoint &contact_point)
{
  const double r = reach_of(contact_point),
               c = contact_point.bulge * base_radius;
  const double bend = (contact_point.is_pole ? -3. : 3.) * c;
  const double floor = 0.1 / body_at(contact_point).inscribed_radius;
  const double meridian = std::max((r - bend) / (r * r), floor);
  return {meridian, contact_point.is_pole ? meridian : std::max(1. / r, floor)};
}

struct Scene
{
  const char *name;
  ContactPoint a, b;
  double angle = 0.; ///< of B about the branch [rad]
};

constexpr double overlap = 2e-5; // [m]

/// The contact point of the particle is along `way` (x or -x).
dem::Quaternion turned(const ContactPoint &contact_point, double way)
{
  if (contact_point.is_pole)
    return dem::Quaternion(
        Eigen::AngleAxisd(way * 0.5 * std::numbers::pi, dem::Vec3::UnitY()));
  return dem::Quaternion(
      Eigen::AngleAxisd(way > 0. ? 0. : std::numbers::pi, dem::Vec3::UnitZ()));
}

/// Normal force in the engine [N].
double force_between(const Scene &scene)
{
  dem::Engine engine(bare_parameters());
  engine.add_particle(body_at(scene.a), dem::Vec3::Zero(), turned(scene.a, 1.));
  const dem::Quaternion about_branch(
      Eigen::AngleAxisd(scene.angle, dem::Vec3::UnitX()));
  engine.add_particle(body_at(scene.b),
                      (reach_of(scene.a) + reach_of(scene.b) - overlap) *
                          dem::Vec3::UnitX(),
                      about_branch * turned(scene.b, -1.));
  engine.advance(1e-12);
  return -engine.particles().load[0].force.x();
}

double exact_force(const Scene &scene)
{
  const Curvatures a = curvatures_at(scene.a), b = curvatures_at(scene.b);
  dem::PairCurvatures pair;
  pair.first_a = std::max(a.meridian, a.parallel);
  pair.second_a = std::min(a.meridian, a.parallel);
  pair.first_b = std::max(b.meridian, b.parallel);
  pair.second_b = std::min(b.meridian, b.parallel);
  // kappa_1 lies along the meridian on one and across it on the other.
  const bool is_crossed =
      (a.meridian > a.parallel) != (b.meridian > b.parallel);
  pair.cos_2psi = (is_crossed ? -1. : 1.) * std::cos(2. * scene.angle);
  return dem::solve_elliptic(dem::mix(aggregate, aggregate),
                             dem::gap_coefficients(pair))
             .prefactors.normal *
         std::pow(overlap, 1.5);
}
} // namespace

// 1e-8 where the particles are turned by nothing or a right angle. Directions
// of kappa_1 are kept in single precision: 6e-8 of cos 2 psi.
std::vector<Row> shape_contacts()
{
  const ContactPoint pole{0.1, true}, side{0.1, false}, flat{2. / 7., false},
      saddle{0.4, false}, hollow{-0.4, true};
  const double third = std::numbers::pi / 6., quarter = 0.5 * std::numbers::pi;
  std::vector<Row> rows;
  for (const Scene &scene : std::initializer_list<Scene>{
           {"pole on pole (circle)", pole, pole},
           {"side on side, crossed", side, side, quarter},
           {"side on side, parallel", side, side},
           {"side on side, 30 degrees", side, side, third},
           {"flat side on flat side, parallel (line)", flat, flat},
           {"saddle on pole", saddle, pole},
           {"saddle on saddle, 30 degrees", saddle, saddle, third},
           {"hollow on pole", hollow, pole},
           {"hollow on hollow", hollow, hollow}})
    rows.push_back({std::string("F, ") + scene.name, "N", exact_force(scene),
                    force_between(scene), 1e-8});
  return rows;
}

// Round-off of the overlap: 45 mm / 2^53 over 20 um.
std::vector<Row> size_ratio()
{
  const double small = 0.005, large = 0.045;
  dem::Engine engine(bare_parameters());
  add_sphere(engine, small, dem::Vec3::Zero());
  add_sphere(engine, large, {small + large - overlap, 0., 0.});
  engine.advance(1e-12);
  const double radius = small * large / (small + large);
  const double force =
      4. / 3. * (5e8 / 0.75) * std::sqrt(radius) * std::pow(overlap, 1.5);
  return {{"F, balls of 5 and 45 mm", "N", force,
           -engine.particles().load[0].force.x(), 1e-9},
          {"E_e", "J", 0.4 * force * overlap, engine.energy().elastic, 1e-9}};
}

// Two balls so heavy that they keep their motion, pressed together by delta,
// slide by s and turn by phi: a = sqrt(R* delta), 1/G* = 2 (2 - nu) / G, R =
// r_c / 2 in the rolling spring, r_c = r - delta / 2 from the centre to the
// contact point. They turn so that they do not slide by turning. The first
// step, in which their contact begins, is too short to move them. The way is so
// short that the branch, which it turns by s / 2r = 5e-7, takes s^2 / 4r off
// delta: 1e-10 of it.
std::vector<Row> springs()
{
  constexpr double radius = 0.01, sunk = 1e-5, speed = 1e-5, spin = 2e-4,
                   dt = 1e-6;
  constexpr int n_steps = 1000;
  dem::EngineParameters p = bare_parameters();
  p.particle.density = 1e25;
  p.particle.friction = 1e10; // of balls this heavy the dashpot is 1e7 N
  p.particle.rolling_friction = 10.;
  p.particle.shear_damping = 0.3;
  dem::Engine engine(p);
  for (const double side : {-1., 1.})
  {
    add_sphere(engine, radius, {side * (radius - 0.5 * sunk), 0., 0.});
    engine.particles().last().velocity.y() = side * 0.5 * speed;
    engine.particles().last().spin.y() = side * 0.5 * spin;
  }
  engine.advance(1e-15);
  advance(engine, dt, n_steps);
  const double lever = radius - 0.5 * sunk;
  const double shear_stiffness =
      8. * 5e8 / (2. * 1.75) * std::sqrt(0.5 * radius * sunk);
  const dem::ContactHistory<double> history = engine.pairs().history(0);
  const double mass = 0.5 * engine.particles().mass(0);
  const double moved = n_steps * dt;
  // The column of the dashpot is in single precision, the load is not.
  const double dashpot = engine.particles().load[0].force.y() - history.shear.y;

  dem::EngineParameters wall = bare_parameters();
  wall.wall.normal_stiffness = 3e6;
  dem::Engine pressed(wall);
  dem::add_plane(pressed, dem::Vec3::Zero(), dem::Vec3::UnitZ());
  add_sphere(pressed, radius, {0., 0., radius - sunk});
  pressed.advance(1e-12);
  return {{"shear spring k_s s", "N", shear_stiffness * speed * moved,
           history.shear.y, 1e-8},
          {"rolling spring k_s R^2 phi", "N m",
           shear_stiffness * 0.25 * lever * lever * spin * moved,
           history.rolling.y, 1e-8},
          {"shear dashpot 2 beta sqrt(m* k_s) ds/dt", "N",
           0.6 * std::sqrt(mass * shear_stiffness) * speed, dashpot, 1e-8},
          {"linear wall k_n delta", "N", 3e6 * sunk,
           pressed.particles().load[0].force.z(), 1e-9},
          {"its energy k_n delta^2 / 2", "J", 0.5 * 3e6 * sunk * sunk,
           pressed.energy().elastic, 1e-9}};
}
} // namespace spall::verify
