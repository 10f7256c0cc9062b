#pragma once

#include <coupling/interface_map.h>
#include <fem/membrane.h>

#include <iosfwd>

namespace coupling
{
/// How a body gets through a window.
struct BodySteps
{
  bool is_implicit = false;
  int n = 1; ///< equal steps of its own in one window
};

/// Of a body, and what has passed since construction [J]: stored + kinetic +
/// lost - external - load_work is constant up to the order of its steps.
struct BodyEnergy
{
  double stored = 0., kinetic = 0.;
  double lost = 0.;      ///< damped or carried away
  double external = 0.;  ///< done by pressure, drives and whoever holds it
  double load_work = 0.; ///< done by the loads of the particles
};

/// A deformable or rigid body in contact with particles, the view of the
/// exchange: nodes with positions and velocities, loads on them. One vector per
/// node in every column.
class DeformableBody
{
public:
  explicit DeformableBody(const BodySteps &steps) : scheme(steps) {}
  virtual ~DeformableBody() = default;
  DeformableBody(const DeformableBody &) = delete;
  DeformableBody &operator=(const DeformableBody &) = delete;

  virtual NodeMotion motion() const = 0;
  /// Lumped; infinite where a node is prescribed [kg].
  virtual std::vector<double> nodal_mass() const = 0;

  /// Through a window under a load that holds throughout it [N]. With springs
  /// its mean is less by K/2 (x - rest) at those of the first nodes that take
  /// them, x where they come to; one implicit step then.
  void advance(FieldView load, double window,
               const fem::NodeSprings *springs = nullptr);
  /// How many of the first nodes take springs, in implicit steps.
  virtual std::size_t n_sprung() const { return 0; }

  bool is_implicit() const { return scheme.is_implicit; }
  int n_steps() const { return scheme.n; }

  /// Velocity Verlet in two halves: half kick and drift; then the load at the
  /// new positions [N] and the second half kick.
  virtual void begin_step(double time_step) = 0;
  virtual void end_step(FieldView load, double time_step) = 0;

  /// Longest explicit step of the body alone [s]; infinite if there is none.
  virtual double stable_time_step() const = 0;
  /// Not less than the square of the largest frequency that springs of these
  /// stiffnesses on its nodes [N/m] give the body without stiffness of its own
  /// [1/s^2]; by default by Gershgorin, largest k / m.
  virtual double squared_frequency(std::span<const double> stiffness) const;

  virtual BodyEnergy energy() const = 0;
  virtual void save(std::ostream &out) const = 0; ///< bit for bit
  virtual void restore(std::istream &in) = 0;     ///< std::runtime_error

private:
  /// This load from now on, as a jump.
  virtual void start(FieldView load) = 0;
  virtual void implicit_step(FieldView load, double time_step) = 0;
  /// The same with springs; a body with springs reports them by n_sprung().
  virtual void implicit_step(FieldView load, double time_step,
                             const fem::NodeSprings &)
  {
    implicit_step(load, time_step);
  }

  BodySteps scheme;
};
} // namespace coupling
