#pragma once

#include <fem/surface_mesh.h>

#include <iosfwd>
#include <memory>
#include <span>
#include <string>

namespace fem
{
struct MembraneParameters
{
  double youngs_modulus = 1.4e6; ///< E [Pa]
  double poisson_ratio = 0.45;   ///< nu [-]
  double thickness = 1e-3;       ///< undeformed [m]
  double density = 1100.;        ///< undeformed [kg/m^3]
  double mass_damping = 0.;      ///< alpha: force -alpha m v on each node [1/s]
};

/// Energies and dissipation since construction [J].
struct MembraneEnergy
{
  double strain = 0.;        ///< stored now
  double kinetic = 0.;       ///< of the free and the tied nodes, now
  double pressure_work = 0.; ///< done by the follower pressure
  double contact_work = 0.;  ///< done by the loads of end_step
  double damping = 0.;       ///< dissipated by mass damping
  double tie_work = 0.;      ///< done by the reactions at the tied nodes
};

/// Membrane of codimension one without bending stiffness: total Lagrangian,
/// St Venant-Kirchhoff in plane stress, large displacements, lumped mass,
/// follower pressure on the outside. Mesh, dofs, masses and output by deal.II;
/// velocity Verlet in time, split in begin_step and end_step so that contact
/// forces at the new positions enter in between. Serial.
class Membrane
{
public:
  /// Throws std::invalid_argument on parameters or meshes that make no sense.
  Membrane(const MembraneParameters &parameters, const SurfaceMesh &reference);
  ~Membrane();
  Membrane(Membrane &&) noexcept;

  /// These nodes follow set_tied_velocity instead of their forces.
  void tie(const std::vector<std::int32_t> &nodes);
  void set_tied_velocity(std::int32_t node, const Eigen::Vector3d &velocity);

  /// Pressure on the outer face, pushing against the outward normal [Pa].
  void set_pressure(double pressure);

  /// Start from rest at these positions (nodes in mesh order) [m].
  void set_positions(std::span<const Eigen::Vector3d> positions);

  /// Half kick with the forces of the last end_step, then drift by dt [s].
  /// Tied nodes drift with their velocity.
  void begin_step(double time_step);

  /// Forces at the present positions: internal, pressure, damping and `load`
  /// (one vector per node [N], from outside); then the second half kick.
  void end_step(std::span<const Eigen::Vector3d> load, double time_step);

  /// Longest stable step of the membrane alone, 2 / omega_max by power
  /// iteration on the tangent at the present state [s].
  double stable_time_step() const;

  std::size_t n_nodes() const;
  std::span<const Eigen::Vector3d> positions() const;  ///< [m]
  std::span<const Eigen::Vector3d> velocities() const; ///< [m/s]
  std::span<const double> nodal_mass() const;          ///< lumped [kg]
  const SurfaceMesh &mesh() const;

  /// Force that the tied node puts on whatever holds it, contact load on that
  /// node included [N].
  Eigen::Vector3d reaction(std::int32_t node) const;

  /// Largest |force| on a free node over the mean internal nodal force [-].
  double unbalanced_force_ratio() const;

  MembraneEnergy energy() const;

  /// Volume enclosed by the tube and flat lids through its two rims [m^3]:
  /// divergence theorem over the quads, lids over the rim polygons.
  double enclosed_volume() const;

  void write_vtu(const std::string &path) const; ///< deformed, with fields

  void save(std::ostream &out) const; ///< full state, bit for bit
  void load(std::istream &in); ///< throws std::runtime_error if it does not fit

private:
  struct State;
  std::unique_ptr<State> state;
};
} // namespace fem
