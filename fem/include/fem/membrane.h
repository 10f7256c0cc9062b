#pragma once

#include <fem/implicit_rule.h>
#include <fem/surface_mesh.h>

#include <array>
#include <cstdint>
#include <iosfwd>
#include <memory>
#include <span>
#include <string>

namespace fem
{
enum class MembraneLaw : std::int64_t
{
  st_venant_kirchhoff, ///< up to stretches of some tens of per cent
  neo_hooke            ///< incompressible, mu = E / 3; poisson_ratio is 0.5
};

/// What a sheet without bending stiffness does in compression.
enum class MembraneWrinkling : std::int64_t
{
  none,         ///< it bears compression as it bears tension
  tension_field ///< it shortens freely: relaxed energy, never in compression
};

struct MembraneParameters
{
  double youngs_modulus = 1.4e6; ///< E [Pa]
  double poisson_ratio = 0.45;   ///< nu [-]
  double thickness = 1e-3;       ///< undeformed [m]
  double density = 1100.;        ///< undeformed [kg/m^3]
  double mass_damping = 0.;      ///< alpha: -alpha m v on free nodes [1/s]
  MembraneLaw law = MembraneLaw::st_venant_kirchhoff;
  /// Tension in the reference surface, the same in all directions, that is
  /// there before any stretch [N/m]; its energy counts from there.
  double tension = 0.;
  MembraneWrinkling wrinkling = MembraneWrinkling::none;
  /// Of the stress of the law, where a tension field is wrinkled or slack: this
  /// share of the compression is borne [-].
  double residual_stiffness = 0.;
};

/// Energies and dissipation since construction or set_positions [J]. The
/// balance strain + kinetic - pressure_work - contact_work + damping - tie_work
/// stays constant up to an error of second order in the time step.
struct MembraneEnergy
{
  double strain = 0.;        ///< stored now
  double kinetic = 0.;       ///< of the free and the tied nodes, now
  double pressure_work = 0.; ///< done by the follower pressure
  double contact_work = 0.;  ///< done by the loads of end_step
  double damping = 0.;       ///< dissipated by mass damping
  /// Done on the membrane by whatever moves the tied nodes: against the force
  /// of reaction(), and to accelerate their mass.
  double tie_work = 0.;
};

/// What gives way at the nodes as they move in an implicit step: at its end the
/// load is less by K (x - rest). One entry per node.
struct NodeSprings
{
  std::vector<Eigen::Matrix3d> stiffness; ///< K, symmetric [N/m]
  std::vector<Eigen::Vector3d> rest;      ///< [m]
};

/// Which of x, y, z are tied.
using TiedAxes = std::array<bool, 3>;

/// Membrane of codimension one without bending stiffness: total Lagrangian,
/// plane stress, large displacements, lumped mass,
/// follower pressure on the outside. Mesh, dofs, masses and output by deal.II;
/// velocity Verlet in time, split in begin_step and end_step so that contact
/// forces at the new positions enter in between. Serial.
class Membrane
{
public:
  /// Throws std::invalid_argument on parameters or meshes that make no sense.
  /// What acts on midpoints of the mesh acts on the ends of their edges.
  Membrane(const MembraneParameters &parameters, const SurfaceMesh &reference);
  ~Membrane();
  Membrane(Membrane &&) noexcept;

  /// These nodes follow set_tied_velocity instead of their forces, along the
  /// chosen axes; along the others they move freely, as a rim that slides.
  /// Further calls add axes. Midpoints of the mesh among the nodes are passed
  /// over, they follow the ends of their edges.
  void tie(const std::vector<std::int32_t> &nodes,
           const TiedAxes &axes = {true, true, true});
  /// Sets the velocity along the tied axes of the node [m/s].
  void set_tied_velocity(std::int32_t node, const Eigen::Vector3d &velocity);

  /// Pressure on the outer face, pushing against the outward normal [Pa].
  void set_pressure(double pressure);

  /// Start from rest at these positions (nodes in mesh order) [m], without
  /// loads; works and dissipation start at zero again.
  void set_positions(std::span<const Eigen::Vector3d> positions);

  /// Shifts all nodes at once, one vector each [m]; what the change of the
  /// strain energy takes is in no account of energy(). Throws
  /// std::invalid_argument on another number of vectors.
  void displace(std::span<const Eigen::Vector3d> shift);

  /// Half kick with the forces of the last end_step (at first: of the start
  /// positions), then drift by dt [s]. Tied nodes drift with their velocity.
  void begin_step(double time_step);

  /// Forces at the present positions: internal, pressure, damping and `load`
  /// (one vector per node [N], from outside); then the second half kick.
  /// Damping is explicit in the first half and implicit in the second, stable
  /// for any alpha. Throws std::runtime_error when the energy is not finite.
  void end_step(std::span<const Eigen::Vector3d> load, double time_step);

  /// From now on this load acts, until the next is given [N]: what comes next
  /// starts with the acceleration that it makes.
  void set_load(std::span<const Eigen::Vector3d> load);

  /// One implicit step of any length to loads that hold at its end: Newton's
  /// method with the exact tangent of material, tension and pressure. Throws
  /// std::runtime_error if it does not converge in 30 corrections; the state is
  /// then as before. With a spectral radius of 0 and long steps: equilibrium.
  /// With springs, which enter the tangent, the load gives way to them. The
  /// message names the node with the largest residual and the probable cause.
  void advance(std::span<const Eigen::Vector3d> load, double time_step,
               const ImplicitRule &rule = average_acceleration(),
               const NodeSprings *springs = nullptr);

  /// Longest stable step of the membrane alone, 2 / omega_max by Lanczos
  /// iteration with the exact tangent (material, tension and pressure) of the
  /// free nodes at the present state [s]; infinite if none is free. A tension
  /// field counts as if it were taut everywhere: it may be in the next step.
  double stable_time_step() const;

  std::size_t n_nodes() const;
  std::span<const Eigen::Vector3d> positions() const;  ///< [m]
  std::span<const Eigen::Vector3d> velocities() const; ///< [m/s]
  /// Lumped, 0 at midpoints, which have given theirs to the ends [kg].
  std::span<const double> nodal_mass() const;
  bool is_tied(std::int32_t node) const; ///< along all axes
  TiedAxes tied_axes(std::int32_t node) const;
  const SurfaceMesh &mesh() const;

  /// Force that the tied node puts on whatever holds it, along the tied axes:
  /// internal, pressure and contact load [N]. The inertia of the node is left
  /// out: whoever holds it adds its nodal_mass to the own mass.
  Eigen::Vector3d reaction(std::int32_t node) const;

  /// On a node: internal, pressure and contact load [N]. At a tied node that is
  /// its reaction, at a free one what accelerates it but for mass damping.
  Eigen::Vector3d force(std::int32_t node) const;

  /// Cauchy stress times the volume of the sheet, int h S_ab F_a (x) F_b dA,
  /// tension positive [J]: minus sum f (x) x over its internal nodal forces.
  Eigen::Matrix3d stress_integral() const;

  /// Share of the surface where the law is in compression along an axis, or
  /// would be without wrinkles [-].
  double wrinkled_share() const;

  /// Largest |force| on a free node, damping left out, over the mean force of
  /// an element on one of its nodes [-].
  double unbalanced_force_ratio() const;

  MembraneEnergy energy() const;

  /// Volume enclosed by the tube and flat lids through its two rims [m^3]:
  /// divergence theorem over the bilinear quads, each lid a fan of triangles
  /// from the mean of its rim.
  double enclosed_volume() const;

  /// Deformed: displacement, velocity, load; area ratio, tension, energy.
  void write_vtu(std::ostream &out) const;

  void save(std::ostream &out) const; ///< full state, bit for bit
  void load(std::istream &in); ///< throws std::runtime_error if it does not fit

private:
  struct State;
  std::unique_ptr<State> state;
};
} // namespace fem
