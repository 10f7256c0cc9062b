#include "case/parameter.h"
#include "errors.h"
#include "triaxial/triaxial.h"

#include <coupling/pressed_quads.h>
#include <dem/binary.h>
#include <dem/engine_boundaries.h>
#include <dem/measure/assembly.h>

#include <cmath>
#include <sstream>
#include <tuple>

namespace spall
{
namespace
{
/// Interval of the checks for rest in the preparation [steps].
constexpr std::int64_t rest_interval = 200;

/// To the target porosity friction goes down by this factor at a time, while
/// the unbalanced force ratio is below so many times its limit.
constexpr double lowering = 0.97, unrest = 10.;
constexpr double least_friction = 1e-3, porosity_tolerance = 0.005; // [-]
} // namespace

void Triaxial::prepare()
{
  servo.update(engine(), schedule.step());
  engine().advance_deferred(schedule.step());
  schedule.count();
  ++in_stage;
  if (in_stage % rest_interval == 0 && is_prepared())
    finish_preparation();
  else if (engine().time() > parameters.preparation.max_time)
    throw RunFailure(unprepared_text());
}

bool Triaxial::is_prepared()
{
  const bool is_resting = is_at_rest();
  if (parameters.preparation.target == PreparationTarget::pressure ||
      is_dense != 0)
    return is_resting;
  densify();
  return false;
}

/// Particles slip into a denser packing as their friction goes down; where the
/// porosity is met, the friction comes back and holds it.
void Triaxial::densify()
{
  const PreparationParameters &target = parameters.preparation;
  if (porosity() <= target.porosity)
  {
    is_dense = 1;
    return engine().set_friction(target.friction);
  }
  const double friction = engine().parameters().particle.friction;
  if (friction < least_friction)
    throw RunFailure("preparation: porosity " + number_text(porosity()) +
                     " without friction, Preparation/porosity = " +
                     number_text(target.porosity) +
                     " cannot be met: must be higher, or the pressure");
  const double worst =
      (preparation.stress.array() / target.pressure - 1.).abs().maxCoeff();
  if (worst < target.stress_tolerance &&
      preparation.unbalanced_ratio < unrest * target.unbalanced_ratio)
    engine().set_friction(lowering * friction);
}

/// Now, of what is not in bodies among the particles [-].
double Triaxial::porosity() const
{
  double bodies = 0.;
  for (const dem::MeshWall &wall : dem::mesh_walls(engine()))
    bodies += wall.body_volume();
  return 1. - dem::solid_volume(synchronized().particles(), ranks()) /
                  (volume() - bodies);
}

void Triaxial::finish_preparation()
{
  preparation.time = engine().time();
  preparation.porosity = porosity();
  if (preparation.porosity <= 0.)
    throw RunFailure(
        "preparation: porosity " + number_text(preparation.porosity) +
        ": the particles have more volume than the specimen, so "
        "they interpenetrate: stiffer contacts "
        "(Particle/shear_modulus, Wall/normal_stiffness) or a lower "
        "Preparation/pressure");
  const PreparationParameters &target = parameters.preparation;
  if (target.target == PreparationTarget::porosity &&
      std::abs(preparation.porosity - target.porosity) > porosity_tolerance)
    throw RunFailure(
        "preparation: porosity " + number_text(preparation.porosity) +
        ", Preparation/porosity = " + number_text(target.porosity) +
        " is not met with Preparation/friction = " +
        number_text(target.friction) + ": must be higher");
  say_prepared();
  hand_over();
  note_prepared();
}

std::string Triaxial::unprepared_text() const
{
  // A servo that is slow or meets a loose packing stays below its target.
  const double target = parameters.preparation.pressure;
  const bool is_swinging =
      (preparation.stress.array() / target - 1.).abs().maxCoeff() > 1.;
  std::ostringstream text;
  text << "preparation is not at rest after " << parameters.preparation.max_time
       << " s: stress " << preparation.stress.transpose() << " Pa (target "
       << parameters.preparation.pressure << "), unbalanced force ratio "
       << preparation.unbalanced_ratio << " (limit "
       << parameters.preparation.unbalanced_ratio
       << (is_swinging
               ? "): the servo walls oscillate about their target: "
                 "Boundary/servo_response_time = " +
                     number_text(parameters.boundary.servo_response_time) +
                     " s must be longer"
               : "): see Preparation/max_time, friction, local_damping");
  return text.str();
}

bool Triaxial::is_at_rest()
{
  preparation.stress = dem::box_stress(engine(), box);
  preparation.unbalanced_ratio = dem::unbalanced_force_ratio(synchronized());
  const PreparationParameters &limits = parameters.preparation;
  const double worst =
      (preparation.stress.array() / limits.pressure - 1.).abs().maxCoeff();
  return worst < limits.stress_tolerance &&
         preparation.unbalanced_ratio < limits.unbalanced_ratio &&
         dem::contact_network(synchronized()).n_contacts > 0;
}

void Triaxial::save_prepared(std::ostream &out) const
{
  dem::write_value(out, watch.state());
  dem::write_value(out, preparation);
  save_particles(out, dem::StateExtent::scene);
  servo.save(out);
}

void Triaxial::take_prepared(std::istream &in)
{
  StepRecord record;
  dem::read_value(in, record);
  watch.set_state(record);
  dem::read_value(in, preparation);
  preparation.is_taken = 1;
  engine().restore(in, shapes.series());
  servo.restore(in);
  hand_over();
  note_prepared();
  note_due();
}

/// Specimens are prepared in the same way whatever closes them later: what is
/// kept serves all.
bool Triaxial::is_gathered() const
{
  return Test::is_gathered() || now == Stage::preparation;
}

/// From the walls to what closes the specimen from now on.
void Triaxial::hand_over()
{
  // What follows depends on the order of the particles, where the membrane sums
  // their loads: it is that of a preparation from a file.
  if (is_gathered() && !Test::is_gathered())
    engine().order_by_id();
  place_boundaries();
  enter(Stage::consolidation);
}

void Triaxial::place_boundaries()
{
  std::tie(lower, upper) = dem::box_corners(engine(), box);
  area = dem::box_section(engine(), box);
  if (parameters.boundary.lateral != Lateral::rigid)
    if (const std::string what = walls_beyond(
            parameters, engine(), 0.5 * (lower + upper), upper - lower);
        !what.empty())
      throw RunFailure("preparation: " + what);
  if (refines_membrane())
    pressed = of_whole(
        [&](const dem::Engine &scene)
        {
          return coupling::pressed_quads(lateral_mesh(parameters, lower, upper),
                                         dem::contact_network_of(scene));
        });
  servo.release(engine(), 2);
  // Particles that carry nothing would fly on for ever.
  engine().come_to_rest();
  engine().set_friction(parameters.particle.friction);
  engine().set_local_damping(parameters.time.local_damping);
  engine().set_renewal(parameters.contact.refresh_tolerance,
                       parameters.contact.skin);
  plane_work_gone = top_plane().work;
  build_cell();
  if (box.is_round() && membrane())
    area = volume() / (upper.z() - lower.z()); // many flat sides
  cell->set_plate({upper.z(), 0., -parameters.preparation.pressure * area,
                   top_plane().force.z(), 0.});
}
} // namespace spall
