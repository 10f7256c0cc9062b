#pragma once

#include <Eigen/Dense>
#include <Eigen/Geometry>

#include <array>
#include <iosfwd>

namespace fem
{
struct PlateBodyParameters
{
  double mass = 1.; ///< [kg]
  /// Principal moments of inertia about the centre of mass, along the axes of
  /// the body, which start along those of the world [kg m^2].
  Eigen::Vector3d inertia = Eigen::Vector3d::Ones();
  Eigen::Vector3d centre = Eigen::Vector3d::Zero(); ///< at the start [m]
  /// Which of these the forces move; the others follow set_motion. Of the
  /// rotations none, one or all three, about the axes of the world.
  std::array<bool, 3> moves{true, true, true};
  std::array<bool, 3> turns{true, true, true};
};

/// Solid cylinder on its face: m r^2 / 2 about z, m (3 r^2 + h^2) / 12 across.
Eigen::Vector3d disc_inertia(double mass, double radius, double thickness);

/// Force and moment about the centre of mass.
struct PlateLoad
{
  Eigen::Vector3d force = Eigen::Vector3d::Zero();  ///< [N]
  Eigen::Vector3d moment = Eigen::Vector3d::Zero(); ///< [N m]
};

/// Rigid plate in space, velocity Verlet in the same two halves as Membrane.
/// Rotation by splitting into turns about the axes of the body, symplectic,
/// of second order, exact in angular momentum (Dullweber, Leimkuhler and
/// McLachlan 1997).
class PlateBody
{
public:
  /// Throws std::invalid_argument on masses and inertias that no body has.
  explicit PlateBody(const PlateBodyParameters &parameters);

  /// Of the components that forces do not move, in the coming steps: the mean
  /// over the step, (value(t + dt) - value(t)) / dt, of a driven motion.
  void set_motion(const Eigen::Vector3d &velocity,
                  const Eigen::Vector3d &spin); ///< [m/s], [rad/s]

  /// From now on these act, until the next are given.
  void set_loads(const PlateLoad &drive, const PlateLoad &reaction);

  void begin_step(double time_step);
  /// What drives the plate (weight included) and what it touches, at the new
  /// position.
  void end_step(const PlateLoad &drive, const PlateLoad &reaction,
                double time_step);

  const Eigen::Vector3d &centre() const { return now.centre; } ///< [m]
  Eigen::Quaterniond orientation() const { return now.orientation; }
  const Eigen::Vector3d &velocity() const { return now.velocity; } ///< [m/s]
  Eigen::Vector3d spin() const; ///< in the world [rad/s]
  /// Of the body's point that is at `position` now [m/s].
  Eigen::Vector3d velocity_at(const Eigen::Vector3d &position) const;
  /// Where a point is now that was at `start` at the start [m].
  Eigen::Vector3d moved(const Eigen::Vector3d &start) const;

  double kinetic_energy() const; ///< [J]
  /// Work of the drive, and of whatever holds or moves what is not free, since
  /// construction [J]. Kinetic energy = drive + holder + work of reactions, up
  /// to second order in the time step.
  double drive_work() const { return now.drive_work; }
  double holder_work() const { return now.holder_work; }
  double reaction_work() const { return now.reaction_work; }

  void save(std::ostream &out) const; ///< full state, bit for bit
  void load(std::istream &in); ///< throws std::runtime_error if it ends early

private:
  /// Without gaps, as checkpoints are compared bit for bit.
  struct State
  {
    Eigen::Vector3d centre, velocity, angular_momentum;
    Eigen::Quaternion<double, Eigen::DontAlign> orientation;
    Eigen::Vector3d given_velocity, given_spin; ///< for the next step
    Eigen::Vector3d held_spin;                  ///< of what is not free
    PlateLoad drive, reaction;
    double drive_work = 0., holder_work = 0., reaction_work = 0.;
  };

  void kick(double half_step);
  void turn(double time_step);
  void book(const Eigen::Vector3d &moved, const Eigen::Vector3d &turned);
  double inertia_about(int axis) const; ///< of the world, now [kg m^2]

  PlateBodyParameters parameters;
  int n_turns = 3;
  State now;
};
} // namespace fem
