#include <coupling/rigid_body.h>
#include <dem/binary.h>

#include <limits>
#include <stdexcept>

namespace coupling
{
namespace
{
using Vector = Eigen::Vector3d;
}

RigidBody::RigidBody(const fem::PlateBodyParameters &p, const Field &nodes,
                     RigidDrive its_drive, const BodySteps &steps)
    : DeformableBody(steps), parameters(p), body(p), reference(nodes),
      drive(std::move(its_drive)), position(nodes),
      velocity(nodes.size(), Vector::Zero())
{
  if (steps.is_implicit)
    throw std::invalid_argument("rigid body: has explicit steps only");
  body.set_loads(driven(0.), {});
}

std::vector<double> RigidBody::nodal_mass() const
{
  return std::vector<double>(reference.size(),
                             std::numeric_limits<double>::infinity());
}

fem::PlateLoad RigidBody::driven(double at) const
{
  return drive.load ? drive.load(at) : fem::PlateLoad{};
}

fem::PlateLoad RigidBody::sum_of(FieldView load) const
{
  fem::PlateLoad sum;
  for (std::size_t k = 0; k < load.size(); ++k)
  {
    sum.force += load[k];
    sum.moment += (position[k] - body.centre()).cross(load[k]);
  }
  return sum;
}

void RigidBody::read_motion()
{
  for (std::size_t k = 0; k < reference.size(); ++k)
  {
    position[k] = body.moved(reference[k]);
    velocity[k] = body.velocity_at(position[k]);
  }
}

void RigidBody::start(FieldView load)
{
  body.set_loads(driven(time), sum_of(load));
}

void RigidBody::begin_step(double time_step)
{
  if (drive.path)
    body.set_motion((drive.path(time + time_step) - drive.path(time)) /
                        time_step,
                    Vector::Zero());
  body.begin_step(time_step);
  time += time_step;
  read_motion();
}

void RigidBody::end_step(FieldView load, double time_step)
{
  body.end_step(driven(time), sum_of(load), time_step);
  read_motion();
}

void RigidBody::implicit_step(FieldView, double)
{
  throw std::logic_error("rigid body: has explicit steps only");
}

double RigidBody::stable_time_step() const
{
  return std::numeric_limits<double>::infinity();
}

/// sum k (1 / m + r^2 / I_min) over what is free: the trace bounds the largest.
double RigidBody::squared_frequency(std::span<const double> stiffness) const
{
  const auto any = [](const std::array<bool, 3> &free)
  { return free[0] || free[1] || free[2]; };
  double sum = 0.;
  for (std::size_t k = 0; k < stiffness.size(); ++k)
  {
    if (any(parameters.moves))
      sum += stiffness[k] / parameters.mass;
    if (any(parameters.turns))
      sum += stiffness[k] * (position[k] - body.centre()).squaredNorm() /
             parameters.inertia.minCoeff();
  }
  return sum;
}

BodyEnergy RigidBody::energy() const
{
  return {0., body.kinetic_energy(), 0., body.drive_work() + body.holder_work(),
          body.reaction_work()};
}

void RigidBody::save(std::ostream &out) const
{
  body.save(out);
  dem::write_value(out, time);
}

void RigidBody::restore(std::istream &in)
{
  body.load(in);
  dem::read_value(in, time);
  read_motion();
}
} // namespace coupling
