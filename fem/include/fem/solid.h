#pragma once

#include <fem/drucker_prager.h>
#include <fem/implicit_rule.h>
#include <fem/solid_mesh.h>

#include <cmath>
#include <functional>
#include <iosfwd>
#include <limits>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace fem
{
/// Of the cells of a layer.
enum class SolidLaw : std::int64_t // no gap in SolidLayer, which is hashed
{
  linear,   ///< small strains, Hooke
  neo_hooke ///< finite strains (neo_hooke.h)
};

/// Linear elastic, isotropic; with a finite cohesion perfectly plastic beyond
/// the cone of Drucker and Prager (drucker_prager.h).
struct SolidLayer
{
  double youngs_modulus = 50e6; ///< E [Pa]
  double poisson_ratio = 0.3;   ///< nu [-], below 0.5
  double density = 1800.;       ///< [kg/m^3]
  /// c [Pa]; infinite: never yields
  double cohesion = std::numeric_limits<double>::infinity();
  double friction_angle = 0.;  ///< phi [rad], from 0 to below pi/2
  double dilatancy_angle = 0.; ///< psi [rad], from 0 to phi

  SolidLaw law = SolidLaw::linear; ///< linear where it may yield

  bool yields() const { return std::isfinite(cohesion); }
  bool is_linear() const { return law == SolidLaw::linear && !yields(); }
};

/// Speeds of plane waves [m/s].
double pressure_wave_speed(const SolidLayer &layer);
double shear_wave_speed(const SolidLayer &layer);

/// Of the linear systems of implicit steps and of equilibrium.
enum class SolidSolver
{
  direct, ///< factors, kept while the matrix stays
  amg,    ///< conjugate gradients with multigrid, which is kept
  /// amg with matrix and multigrid spread over all ranks of MPI: advance and
  /// settle are collective, and every rank has the same body and loads. The
  /// motion, the same bits on every rank, is that of amg to its tolerance.
  distributed_amg
};

struct SolidParameters
{
  std::vector<SolidLayer> layers{SolidLayer{}}; ///< by number of the layer
  double mass_damping = 0.;      ///< Rayleigh alpha: force -alpha m v [1/s]
  double stiffness_damping = 0.; ///< Rayleigh beta: force -beta K v [s]
  SolidSolver solver = SolidSolver::direct;
  double solver_tolerance = 1e-10; ///< amg: residual over load [-]
};

/// Energies and dissipation since construction [J]. The balance strain +
/// kinetic + damping + plastic + absorbed - load_work - support_work is
/// constant: to round-off in quasi-static steps and with average acceleration,
/// to second order in the time step in explicit ones.
struct SolidEnergy
{
  /// stored now, in strain and, where an initial stress does work in plastic
  /// flow, in the place of the weight that it balances
  double strain = 0.;
  double kinetic = 0.;  ///< now
  double damping = 0.;  ///< dissipated by Rayleigh damping
  double plastic = 0.;  ///< dissipated by plastic flow, initial stress included
  double absorbed = 0.; ///< carried away through absorbing boundaries
  double load_work = 0.;    ///< done by the loads
  double support_work = 0.; ///< done by whatever moves the supports
};

/// Longest step of begin_step and end_step, and why. Stiffness damping
/// shortens both.
struct StepLimit
{
  double time_step = 0.; ///< 2 / omega_max by Lanczos iteration [s]
  /// 2 / omega of the fastest single cell: no mode of the body is faster [s].
  double guaranteed = 0.;
  std::string reason; ///< the fastest cell, in words
};

/// Elastic body on eight-node cells, lumped mass: at small strains with
/// incompatible modes; layers that yield or are neo-Hookean with the mean
/// volume change of the cell, Newton's method in all implicit and static steps.
/// Three ways to move it, which may follow one another: explicit (begin_step,
/// end_step), implicit (advance), without inertia (settle). Displacements and
/// loads are one vector per node of the mesh. Every rank has all of it, and
/// moves it alone but for SolidSolver::distributed_amg.
class Solid
{
public:
  /// Throws std::invalid_argument on parameters or meshes that make no sense.
  Solid(const SolidParameters &parameters, const SolidMesh &mesh);
  ~Solid();
  Solid(Solid &&) noexcept;

  /// These components follow the support from now on; at rest unless moved.
  void fix(std::int32_t boundary, const std::array<bool, 3> &components);
  void fix_node(std::int32_t node, const std::array<bool, 3> &components);
  /// Velocity of the fixed components of a node in the coming steps [m/s].
  void set_support_velocity(std::int32_t node, const Eigen::Vector3d &velocity);
  /// Where settle puts the fixed components of a node [m].
  void set_support_displacement(std::int32_t node,
                                const Eigen::Vector3d &displacement);

  /// Dashpots rho c_p along the normal and rho c_s across it per area: no
  /// reflection of waves that meet the boundary at right angles (Lysmer and
  /// Kuhlemeyer 1969). They hold nothing at rest.
  void absorb(std::int32_t boundary);

  /// Springs that hold a boundary at rest as the half-space beyond it would
  /// under a vertical load at `origin` on its level surface, exactly for a
  /// uniform body of this layer: per area, with R the distance, r = (x - o) /
  /// R, c = -r_z, n the normal, along z 6 G c^2 (r . n) / (R (2 (1 - nu) +
  /// c^2)) (Boussinesq 1885); along x and y, where that load has no say, G (r .
  /// n) / (2 R). Besides absorb, which holds nothing at rest. Throws
  /// std::invalid_argument where the boundary does not face away from there.
  void hold_far_field(std::int32_t boundary, const Eigen::Vector3d &origin);

  /// Stress in which the mesh is given, at the points of the cells that may
  /// yield [Pa]: it is in balance with loads that are not among those given,
  /// the weight of the ground, and counts for the strength alone. Without it
  /// the stress counts from zero. Before anything has moved.
  void set_initial_stress(
      const std::function<Voigt(const Eigen::Vector3d &)> &stress);

  /// Adds to the initial stress what the cells that may yield carry at rest
  /// under these loads [N], flow on the way there included. Displacements,
  /// plastic strain and energies count from there; what is loaded later comes
  /// on top of these loads, as linear layers have it anyway. Throws
  /// std::runtime_error as settle, std::invalid_argument with layers at finite
  /// strains. Before anything has moved.
  void start_under(std::span<const Eigen::Vector3d> load);

  /// Explicit, as Membrane does it: half kick and drift; then forces at the
  /// new positions with these loads [N], and the second half kick. Dashpots
  /// and mass damping are implicit in the second half; stiffness damping is
  /// half a step late. Throws std::runtime_error when the energy is not finite.
  void begin_step(double time_step);
  void end_step(std::span<const Eigen::Vector3d> load, double time_step);
  StepLimit stable_time_step() const;

  /// From now on this load acts, until the next is given [N]: what comes next
  /// starts with the acceleration that it makes.
  void set_load(std::span<const Eigen::Vector3d> load);

  /// One implicit step to loads that hold at its end. The matrix is factored,
  /// or its multigrid made, again only when the step, the rule or the supports
  /// have changed. Where a layer is not linear, Newton's method with the
  /// consistent tangent. Throws std::runtime_error if a solver fails.
  void advance(std::span<const Eigen::Vector3d> load, double time_step,
               const ImplicitRule &rule = average_acceleration());

  /// Equilibrium under these loads without inertia; velocities become zero.
  /// Throws std::runtime_error if the supports do not hold the body, or if
  /// layers that are not linear find no equilibrium; nothing has moved then.
  void settle(std::span<const Eigen::Vector3d> load);

  /// Conjugate gradient steps of the last linear system; 0 with factors.
  int solver_iterations() const;

  /// Newton's method in the last implicit step or settle, where a layer is not
  /// linear: imbalance over forces before each iteration and at the end [-].
  std::span<const double> newton_residuals() const;

  const SolidMesh &mesh() const;
  std::span<const Eigen::Vector3d> displacements() const; ///< [m]
  std::span<const Eigen::Vector3d> velocities() const;    ///< [m/s]
  std::span<const double> nodal_mass() const; ///< lumped [kg]; 0 if hanging
  SolidEnergy energy() const;
  /// Force that a node puts on its support: elastic, viscous and load [N]; the
  /// inertia of the node is left out.
  Eigen::Vector3d reaction(std::int32_t node) const;
  /// Stress in the middle of a cell, beyond an initial one, tension positive:
  /// xx, yy, zz, yz, zx, xy [Pa].
  std::array<double, 6> stress(std::size_t cell) const;
  /// Share of the volume of the layers that may yield that has flown [-]; 0
  /// without such layers.
  double yielded_share() const;

  /// Displacement, velocity and load of the nodes, stress of the cells.
  void write_vtu(std::ostream &out) const;

  void save(std::ostream &out) const; ///< full state, bit for bit
  void load(std::istream &in); ///< throws std::runtime_error if it does not fit

private:
  friend class CondensedSolid;
  struct State;
  std::unique_ptr<State> state;
};
} // namespace fem
