#include "breakage_cases.h"
#include "scenes.h"

#include <dem/contact/elliptic.h>
#include <dem/engine_boundaries.h>
#include <dem/measure/assembly.h>

#include <algorithm>
#include <cmath>
#include <numbers>

// Particles pressed until they break, in the engine.
namespace spall::verify
{
namespace
{
constexpr double fracture_energy = 1e4; // G_c [J/m^2]
const dem::Vec3 axes(0.012, 0.010, 0.008);

/// R = 1 / sqrt(K_G) at the tip of the long axis: b c / a [m].
double tip_radius()
{
  return axes.y() * axes.z() / axes.x();
}

/// The long axis along x; error of the series below 1e-8.
dem::ParticleShape ellipsoid()
{
  return body_of(project(20, [](const dem::Vec3 &s)
                         { return ellipsoid_radius(axes, s); }));
}

dem::EngineParameters press_parameters()
{
  dem::EngineParameters p = bare_parameters();
  p.breakage.is_active = true;
  p.breakage.fracture_energy = fracture_energy;
  p.wall.normal_damping = 0.2;
  return p;
}

/// An ellipsoid between two plates that close on its tips at this speed, from
/// touch [m/s].
dem::Engine press(double speed)
{
  dem::Engine engine(press_parameters());
  engine.add_particle(ellipsoid(), dem::Vec3::Zero(),
                      dem::Quaternion::Identity());
  for (const double side : {-1., 1.})
  {
    dem::add_plane(engine, {side * axes.x(), 0., 0.},
                   -side * dem::Vec3::UnitX());
    dem::planes(engine).back().velocity.x() = -side * speed;
  }
  return engine;
}

/// Advances until something breaks or 20 ms are over.
std::vector<dem::BreakageEvent> next_events(dem::Engine &engine, double dt)
{
  std::vector<dem::BreakageEvent> events;
  while (events.empty() && engine.time() < 0.02)
  {
    engine.advance(dt);
    events = engine.take_events();
  }
  return events;
}

double press_step(const dem::Engine &engine)
{
  return 0.1 * std::sqrt(engine.particles().mass(0) /
                         engine.parameters().wall.normal_stiffness);
}
} // namespace

// In n steps the sum of Eq. 4 falls short of the integral by ln(n) / 2n,
// n = 4000: 1e-3. G_c or R wrong by 1 % moves the force by as much.
std::vector<Row> press_on_walls()
{
  dem::Engine engine = press(1e-3);
  const std::vector<dem::BreakageEvent> events =
      next_events(engine, press_step(engine));
  if (events.empty())
    return {{"number of events", "-", 2., 0., 0.}};
  const dem::BreakageEvent &first = events[0];
  const double area = 2. * std::numbers::pi * tip_radius() * first.overlap;
  return {{"force at the first event", "N",
           2. * std::numbers::pi * tip_radius() * fracture_energy,
           first.force_before, 2e-3},
          {"its mode (1: cumulative)", "-", 1.,
           first.mode == dem::BreakageMode::cumulative ? 1. : 2., 0.},
          {"events of the step (both tips)", "-", 2.,
           static_cast<double>(events.size()), 0.},
          {"volume removed, A_i delta / 2", "m^3", 0.5 * area * first.overlap,
           first.removed_volume, 1e-5},
          {"fracture energy G_c A_i", "J", fracture_energy * area,
           first.fracture_energy, 1e-5},
          {"elastic energy F delta / 2", "J",
           0.5 * first.force_before * first.overlap, first.elastic_energy,
           1e-12}};
}

namespace
{
/// Two ellipsoids tip to tip, so heavy that their motion is given: they close
/// at 0.2 m/s and slide past each other at this speed [m/s].
dem::Engine tips(const dem::BreakageParameters &breakage, double sliding)
{
  dem::EngineParameters p = press_parameters();
  p.breakage = breakage;
  p.particle.density = 1e9;
  p.particle.friction = 0.5;
  dem::Engine engine(p);
  for (const double side : {-1., 1.})
  {
    engine.add_particle(ellipsoid(), {side * axes.x(), 0., 0.},
                        dem::Quaternion::Identity());
    engine.particles().last().velocity = {-side * 0.1, -side * 0.5 * sliding,
                                          0.};
  }
  return engine;
}

std::vector<dem::BreakageEvent> first_events(dem::Engine &engine)
{
  std::vector<dem::BreakageEvent> events;
  while (events.empty() && engine.time() < 1e-2)
  {
    engine.advance(1e-6);
    events = engine.take_events();
  }
  // An empty one fails every row.
  return events.empty() ? std::vector<dem::BreakageEvent>(1) : events;
}

/// Speed of the first particle after the step of its event less that of a
/// particle that never breaks: the new force acts from the next half step on
/// [m/s].
double speed_jump(const dem::Engine &broken)
{
  dem::BreakageParameters tough;
  tough.fracture_energy = 1e9;
  dem::Engine whole = tips(tough, 0.);
  advance(whole, 1e-6, static_cast<int>(broken.n_steps()));
  return broken.particles().velocity(0).x() - whole.particles().velocity(0).x();
}

/// 3 pi R G_c at the tips [N].
const double slow_threshold =
    3. * std::numbers::pi * tip_radius() * fracture_energy;
} // namespace

// 3000 steps; G_c or R wrong by 1 % moves the force by as much.
std::vector<Row> press_of_particles()
{
  dem::Engine engine = tips({}, 0.);
  const std::vector<dem::BreakageEvent> events = first_events(engine);
  const dem::BreakageEvent &first = events[0];
  const auto &load = engine.particles().load;
  return {{"force at the first event", "N", slow_threshold, first.force_before,
           2e-3},
          {"events of the step (one side of a contact)", "-", 1.,
           static_cast<double>(events.size()), 0.},
          {"elastic energy left", "J",
           first.elastic_energy - first.released_energy,
           engine.energy().elastic, 1e-12},
          at_most("force after over force before, below 0.9", "-",
                  first.force_after / first.force_before, 0.9),
          at_most("sum of the forces on both", "N",
                  (load[0].force + load[1].force).norm(), 1e-10),
          at_most("jump of the speed in the step of the event", "m/s",
                  speed_jump(engine), 1e-12)};
}

// Tip on tip 4 A B is four times K_G: half of the threshold. Half of the
// overlap takes a quarter of the volume. Sliding as fast as it closes, the
// shear spring is at its limit f F all the way: E_s / E_e = f^2 C_H / (0.8
// C_s).
std::vector<Row> choices()
{
  dem::BreakageParameters relative, shared, sheared, both;
  relative.curvature = dem::CapCurvature::relative;
  shared.share = dem::EnergyShare::compliance;
  sheared.energy = dem::CriterionEnergy::with_shear;
  both.sides = dem::BrokenSides::both;
  const auto first = [](const dem::BreakageParameters &breakage, double sliding)
  {
    dem::Engine engine = tips(breakage, sliding);
    return first_events(engine);
  };
  const dem::BreakageEvent half = first(shared, 0.)[0];
  const dem::Elasticity particle{.shear_modulus = 5e8, .poisson_ratio = 0.25};
  const dem::HertzPrefactors contact =
      dem::solve_elliptic(
          dem::mix(particle, particle),
          {axes.x() / (axes.y() * axes.y()), axes.x() / (axes.z() * axes.z())})
          .prefactors;
  const double shear_share = 0.25 * contact.normal / (0.8 * contact.tangential);
  return {{"curvature = relative: force at the first event", "N",
           0.5 * slow_threshold, first(relative, 0.)[0].force_before, 2e-3},
          {"share = compliance: force at the first event", "N", slow_threshold,
           half.force_before, 2e-3},
          {"share = compliance: volume removed", "m^3",
           std::numbers::pi * tip_radius() * 0.25 * half.overlap * half.overlap,
           half.removed_volume, 1e-5},
          {"energy = with_shear: force at the first event", "N",
           slow_threshold / (1. + shear_share),
           first(sheared, 0.2)[0].force_before, 1e-2},
          {"energy = normal, sliding: force at the first event", "N",
           slow_threshold, first({}, 0.2)[0].force_before, 1e-2},
          {"sides = both: events of the step", "-", 2.,
           static_cast<double>(first(both, 0.).size()), 0.}};
}

// Crushed on until some 30 pieces are off. Volumes are sums over 3200 nodes of
// 1e-6 m^3 each, to 1e-16 of that.
std::vector<Row> energy_balance()
{
  dem::Engine engine = press(5e-3);
  const double volume = engine.particles().shape[0].volume;
  const double dt = press_step(engine);
  double removed = 0., fractured = 0., released = 0., jump = 0.;
  while (engine.n_events() < 30 && engine.time() < 0.02)
    for (const dem::BreakageEvent &event : next_events(engine, dt))
    {
      removed += event.removed_volume;
      fractured += event.fracture_energy;
      released += event.released_energy + event.kinetic_energy;
      jump = std::max(jump, event.force_after / event.force_before);
    }
  const dem::EngineEnergy e = engine.energy();
  return {{"abrasion", "-", removed / volume,
           dem::abrasion(engine.particles(), *dem::one_rank()), 1e-13, 1.},
          {"mass", "kg", (volume - removed) * 2750., engine.particles().mass(0),
           1e-12},
          {"energy of the new surfaces", "J", fractured, e.fracture, 1e-12},
          {"energy released", "J", released, e.breakage, 1e-12},
          at_most("largest force after over before", "-", jump, 1.),
          at_most("energy residual over the work", "-",
                  energy_residual(engine) / e.work_of("planes"), 0.01)};
}
} // namespace spall::verify
