#include <fem/plate_body.h>

#include <cmath>
#include <istream>
#include <ostream>
#include <stdexcept>
#include <string>

namespace fem
{
namespace
{
using Vector = Eigen::Vector3d;
using Turn = Eigen::AngleAxisd;

void check(const PlateBodyParameters &p)
{
  if (!(p.mass > 0.) || !std::isfinite(p.mass))
    throw std::invalid_argument("plate mass = " + std::to_string(p.mass) +
                                " kg: must be above 0");
  for (int axis = 0; axis < 3; ++axis)
  {
    const double own = p.inertia(axis);
    const double others = p.inertia.sum() - own;
    if (!(own > 0.) || !std::isfinite(own) || own > others * (1. + 1e-12))
      throw std::invalid_argument(
          "plate inertia = " + std::to_string(own) +
          " kg m^2: must be above 0 and at most the sum of the other two");
  }
}
} // namespace

Eigen::Vector3d disc_inertia(double mass, double radius, double thickness)
{
  const double across =
      mass * (3. * radius * radius + thickness * thickness) / 12.;
  return {across, across, 0.5 * mass * radius * radius};
}

PlateBody::PlateBody(const PlateBodyParameters &p)
    : parameters(p), n_turns(p.turns[0] + p.turns[1] + p.turns[2])
{
  check(p);
  if (n_turns == 2)
    throw std::invalid_argument("plate: two free rotations, must be none, one "
                                "or three");
  now.centre = p.centre;
  now.velocity = now.angular_momentum = Vector::Zero();
  now.given_velocity = now.given_spin = now.held_spin = Vector::Zero();
  now.orientation.setIdentity();
}

void PlateBody::set_motion(const Vector &velocity, const Vector &spin)
{
  now.given_velocity = velocity;
  now.given_spin = spin;
}

void PlateBody::set_loads(const PlateLoad &drive, const PlateLoad &reaction)
{
  now.drive = drive;
  now.reaction = reaction;
}

double PlateBody::inertia_about(int axis) const
{
  const Vector in_body = now.orientation.conjugate() * Vector::Unit(axis);
  return in_body.cwiseAbs2().dot(parameters.inertia);
}

/// With one or no free rotation the held spin stands for the others, and the
/// angular momentum holds the component of the free one only.
Vector PlateBody::spin() const
{
  if (n_turns == 3)
  {
    const Vector in_body = now.orientation.conjugate() * now.angular_momentum;
    return now.orientation * in_body.cwiseQuotient(parameters.inertia);
  }
  Vector spin = now.held_spin;
  for (int axis = 0; axis < 3; ++axis)
    if (parameters.turns[static_cast<std::size_t>(axis)])
      spin(axis) = now.angular_momentum(axis) / inertia_about(axis);
  return spin;
}

void PlateBody::kick(double half_step)
{
  const Vector force = now.drive.force + now.reaction.force;
  const Vector moment = now.drive.moment + now.reaction.moment;
  for (int axis = 0; axis < 3; ++axis)
  {
    const auto a = static_cast<std::size_t>(axis);
    if (parameters.moves[a])
      now.velocity(axis) += half_step / parameters.mass * force(axis);
    if (parameters.turns[a])
      now.angular_momentum(axis) += half_step * moment(axis);
  }
}

/// Free motion of the rotation: the momentum stays in the world, the body turns
/// about its axes x, y, z, y, x one after the other.
void PlateBody::turn(double time_step)
{
  if (n_turns < 3)
  {
    const Vector angle = time_step * spin();
    if (angle.norm() > 0.)
      now.orientation =
          Turn(angle.norm(), angle.normalized()) * now.orientation;
    now.orientation.normalize();
    return;
  }
  const auto about = [&](int axis, double duration)
  {
    const Vector momentum = now.orientation.conjugate() * now.angular_momentum;
    const double angle = duration * momentum(axis) / parameters.inertia(axis);
    now.orientation = now.orientation * Turn(angle, Vector::Unit(axis));
  };
  about(0, 0.5 * time_step);
  about(1, 0.5 * time_step);
  about(2, time_step);
  about(1, 0.5 * time_step);
  about(0, 0.5 * time_step);
  now.orientation.normalize();
}

/// Half of the work of the present loads.
void PlateBody::book(const Vector &moved, const Vector &turned)
{
  const auto half_work = [&](const PlateLoad &load)
  { return 0.5 * (load.force.dot(moved) + load.moment.dot(turned)); };
  now.drive_work += half_work(now.drive);
  now.reaction_work += half_work(now.reaction);
  const Vector force = now.drive.force + now.reaction.force;
  const Vector moment = now.drive.moment + now.reaction.moment;
  for (int axis = 0; axis < 3; ++axis)
  {
    const auto a = static_cast<std::size_t>(axis);
    if (!parameters.moves[a])
      now.holder_work -= 0.5 * force(axis) * moved(axis);
    if (!parameters.turns[a])
      now.holder_work -= 0.5 * moment(axis) * turned(axis);
  }
}

void PlateBody::begin_step(double time_step)
{
  const double before = kinetic_energy();
  for (int axis = 0; axis < 3; ++axis)
    if (!parameters.moves[static_cast<std::size_t>(axis)])
      now.velocity(axis) = now.given_velocity(axis);
  now.held_spin = now.given_spin;
  now.holder_work += kinetic_energy() - before;
  kick(0.5 * time_step);
  const Vector moved = time_step * now.velocity;
  book(moved, time_step * spin());
  now.centre += moved;
  turn(time_step);
}

void PlateBody::end_step(const PlateLoad &drive, const PlateLoad &reaction,
                         double time_step)
{
  now.drive = drive;
  now.reaction = reaction;
  book(time_step * now.velocity, time_step * spin());
  kick(0.5 * time_step);
}

Vector PlateBody::velocity_at(const Vector &position) const
{
  return now.velocity + spin().cross(position - now.centre);
}

Vector PlateBody::moved(const Vector &start) const
{
  return now.centre + now.orientation * (start - parameters.centre);
}

double PlateBody::kinetic_energy() const
{
  const Vector spin_in_body = now.orientation.conjugate() * spin();
  return 0.5 * parameters.mass * now.velocity.squaredNorm() +
         0.5 * spin_in_body.cwiseAbs2().dot(parameters.inertia);
}

void PlateBody::save(std::ostream &out) const
{
  out.write(reinterpret_cast<const char *>(&now), sizeof(now));
  if (!out)
    throw std::runtime_error("plate checkpoint: cannot write");
}

void PlateBody::load(std::istream &in)
{
  State state;
  if (!in.read(reinterpret_cast<char *>(&state), sizeof(state)))
    throw std::runtime_error("plate checkpoint: the file ends too early");
  now = state;
}
} // namespace fem
