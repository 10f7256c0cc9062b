#pragma once

namespace fem
{
/// Rigid plate that moves along z only: m z'' = drive + reaction, velocity
/// Verlet in the same two halves as the membrane.
class RigidPlate
{
public:
  /// Throws std::invalid_argument unless the mass is positive [kg]; `height` is
  /// the position of its lower face [m].
  RigidPlate(double mass, double height);

  /// Half kick and drift by dt [s]; velocity() is then that of the whole step.
  void begin_step(double time_step);
  /// Forces at the new position, positive upward [N]: what drives the plate and
  /// what it touches; then the second half kick.
  void end_step(double drive, double reaction, double time_step);

  double height() const { return z; }       ///< [m]
  double velocity() const { return speed; } ///< [m/s]
  double kinetic_energy() const { return 0.5 * mass * speed * speed; } ///< [J]
  /// Work of the driving force since construction [J].
  double drive_work() const { return work; }
  /// Acceleration force m z'' of the last step, the resultant [N].
  double resultant() const { return last_drive + last_reaction; }

  /// Takes the state of another plate of this mass (restart).
  struct State
  {
    double z = 0., speed = 0., last_drive = 0., last_reaction = 0., work = 0.;
  };
  State state() const { return {z, speed, last_drive, last_reaction, work}; }
  void set_state(const State &state);

private:
  double mass, z;
  double speed = 0., last_drive = 0., last_reaction = 0., work = 0.;
};
} // namespace fem
