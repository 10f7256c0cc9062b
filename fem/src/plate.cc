#include <fem/plate.h>

#include <stdexcept>
#include <string>

namespace fem
{
RigidPlate::RigidPlate(double plate_mass, double height)
    : mass(plate_mass), z(height)
{
  if (!(mass > 0.))
    throw std::invalid_argument("plate mass = " + std::to_string(mass) +
                                " kg: must be above 0");
}

void RigidPlate::begin_step(double time_step)
{
  speed += 0.5 * time_step * resultant() / mass;
  z += time_step * speed;
  work += 0.5 * time_step * last_drive * speed;
}

void RigidPlate::end_step(double drive, double reaction, double time_step)
{
  work += 0.5 * time_step * drive * speed;
  last_drive = drive;
  last_reaction = reaction;
  speed += 0.5 * time_step * resultant() / mass;
}

void RigidPlate::set_state(const State &state)
{
  z = state.z;
  speed = state.speed;
  last_drive = state.last_drive;
  last_reaction = state.last_reaction;
  work = state.work;
}
} // namespace fem
