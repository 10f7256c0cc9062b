#pragma once

#include "hyper_cells.h"
#include "multigrid.h"
#include "plastic_cells.h"
#include "solid_system.h"

#include <fem/solid.h>

#include <optional>

namespace fem
{
/// What changes with time. Loads and forces of hanging nodes are with their
/// parents.
struct SolidMotion
{
  NodeField displacement, velocity, acceleration; ///< [m], [m/s], [m/s^2]
  NodeField moved;                                ///< in the present step [m]
  NodeField load, elastic, viscous; ///< f, internal and beta K v [N]
  NodeField relief;                 ///< K u less the internal force [N]
  NodeField support_velocity, support_displacement;
  PlasticState plastic; ///< empty without layers that yield
  SolidEnergy done;     ///< works and dissipation so far [J]
  bool has_acceleration = false;
};

/// Solver of the last implicit or quasi-static matrix, and what it was.
struct KeptSolver
{
  SystemWeights weights;
  int version = -1; ///< of the supports and dashpots
  std::optional<SparseFactor> factor;
  std::optional<MultigridSolver> multigrid;
};

/// One implicit step, as advance is asked for it.
struct ImplicitStep
{
  std::span<const Eigen::Vector3d> load; ///< at its end [N]
  double time_step = 0.;                 ///< [s]
  ImplicitRule rule;
};

/// A correction x of what was predicted without further flow: weights x =
/// share * relief(predicted + reach * x), on the free components.
struct FlowSystem
{
  const NodeField *predicted = nullptr; ///< displacements [m]
  SystemWeights weights;
  double reach = 1., share = 1.;
};

struct Solid::State
{
  State(const SolidParameters &parameters, const SolidMesh &mesh);

  SolidParts parts() const
  {
    return {mesh, elastic, supports, mass, dashpot, bedding};
  }
  /// K u with the bedding; hanging nodes hand over to their parents [N].
  void multiply(std::span<const Eigen::Vector3d> u,
                std::span<Eigen::Vector3d> out) const;
  /// Dashpots and mass damping on the free components.
  void update_dashpots();
  /// Field of the free components that this matrix turns into the given one.
  void solve(const SystemWeights &weights, NodeField &field);

  /// All but the dashpots and mass damping [N].
  Eigen::Vector3d force(std::size_t k) const
  {
    return now.load[k] - now.elastic[k] - now.viscous[k];
  }
  void put_supports_in_motion();
  void set_load(std::span<const Eigen::Vector3d> load);
  /// Forces of the present motion; books the plastic flow on the way to it.
  void update_forces();
  /// Half the work of the present forces over now.moved.
  void book_half_step();
  void start_accelerations();
  NodeField mixed_force(const NodeField &start, const NodeField &speed,
                        double end) const;
  void solve_accelerations(const ImplicitStep &step, const NodeField &start,
                           const NodeField &speed);
  bool is_linear() const { return plastic.empty() && hyper.empty(); }
  NodeField total_relief(std::span<const Eigen::Vector3d> displacement,
                         const PlasticState &flown) const;
  void relieve(std::span<Eigen::Vector3d> force) const;
  NodeField relief(const NodeField &displacement) const;
  Eigen::VectorXd imbalance(const FlowSystem &system,
                            const NodeField &correction) const;
  NodeField newton_step(const FlowSystem &system, const NodeField &correction,
                        const Eigen::VectorXd &left) const;
  NodeField flow_correction(const FlowSystem &system);
  NodeField equilibrium(std::span<const Eigen::Vector3d> load);
  void settle(std::span<const Eigen::Vector3d> load);
  double strain_energy() const;
  double largest_frequency() const;
  std::uint64_t fingerprint() const; ///< asked often, made once

  const SolidParameters parameters;
  const SolidMesh mesh;
  const SolidOperator elastic;
  const HyperCells hyper;
  PlasticCells plastic;
  SolidSupports supports;
  std::vector<double> mass;              ///< with that of hanging nodes [kg]
  std::vector<Eigen::Matrix3d> absorber; ///< of absorbing boundaries [kg/s]
  std::vector<Eigen::Matrix3d> dashpot;  ///< with mass damping, free part only
  std::vector<char> has_absorber;
  std::vector<Eigen::Matrix3d> bedding; ///< empty: none [N/m]
  SolidMotion now;
  KeptSolver kept;
  std::vector<double> newton_residuals; ///< of the last correction
  int n_dashpot_changes = 0;
  mutable std::optional<std::uint64_t> identity;
};

/// Throws std::invalid_argument with the name of what makes no sense.
void check_solid(const SolidParameters &parameters, const SolidMesh &mesh);
void check_solid_step(double time_step);
void check_solid_loads(std::size_t n_given, std::size_t n_nodes);

struct SolidFields
{
  std::span<const Eigen::Vector3d> displacement, velocity, load;
  std::vector<std::array<double, 6>> stress; ///< of the cells [Pa]
};
/// As a file .vtu; the caller checks the stream.
void write_solid_vtu(std::ostream &out, const SolidMesh &mesh,
                     const SolidFields &fields);
} // namespace fem
