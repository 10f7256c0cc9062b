#pragma once

#include "followers.h"
#include "membrane_motion.h"
#include "membrane_space.h"

#include <fem/membrane.h>

#include <string>

namespace fem
{
/// What an implicit step starts from.
struct MembraneStep
{
  double time_step = 0.; ///< [s]
  ImplicitRule rule;
  std::vector<Eigen::Vector3d> position, velocity, acceleration, force;
  std::vector<Eigen::Vector3d> predicted; ///< positions without new a [m]
  std::span<const Eigen::Vector3d> load;  ///< as given [N]
  const NodeSprings *springs = nullptr;   ///< null: none
};

/// Throw std::invalid_argument.
void check_membrane_step(double time_step);
void check_membrane_size(const char *what, std::size_t given,
                         std::size_t n_nodes);

struct Membrane::State
{
  State(const MembraneParameters &p, const SurfaceMesh &reference);

  /// By its forces along some axis: neither tied along all nor with the ends of
  /// its edge.
  bool is_free(std::size_t k) const
  {
    return now.tied[k] != all_axes && !midpoints.is_hanging(k);
  }
  /// What of a vector is along the axes where node k is not tied.
  Eigen::Vector3d free_along(std::size_t k, const Eigen::Vector3d &vector) const
  {
    return free_part(now.tied[k], vector);
  }
  /// What of it is along the tied axes.
  Eigen::Vector3d tied_along(std::size_t k, const Eigen::Vector3d &vector) const
  {
    return free_part(all_axes & ~now.tied[k], vector);
  }
  std::size_t checked_node(std::int32_t node) const;
  std::size_t tied_node(std::int32_t node) const;
  Eigen::Vector3d force(std::size_t k) const;
  void set_velocity(std::size_t k, const Eigen::Vector3d &velocity);
  void book_half_step(std::size_t k);
  void start_from(std::span<const Eigen::Vector3d> positions);
  /// Load from outside that acts from now on.
  void take_load(std::span<const Eigen::Vector3d> load);
  /// Internal forces and areas at the present positions.
  void find_forces();
  double round_off(const MembraneStep &step) const;
  /// Which node is farthest from equilibrium, and the probable cause.
  std::string why_no_equilibrium(const std::vector<Eigen::Vector3d> &residual,
                                 double asked) const;
  void book_step_from(const MembraneMotion &before);
  void start_accelerations();
  /// Inertia and damping less the forces of the step, free nodes only [N].
  std::vector<Eigen::Vector3d> residual(const MembraneStep &step) const;
  /// The same after the forces at the present positions.
  std::vector<Eigen::Vector3d> residual_here(const MembraneStep &step);
  /// The same; where a wrinkle that comes or goes has made it larger than it
  /// was, the positions go back half of the way, and again.
  std::vector<Eigen::Vector3d>
  better_residual(const MembraneStep &step,
                  const std::vector<Eigen::Vector3d> &from, double size_from);
  /// The load that the springs leave at the present positions.
  void give_way(const MembraneStep &step);
  /// Velocities and accelerations that the positions stand for.
  void follow_positions(const MembraneStep &step);
  /// One correction of the positions by the consistent tangent.
  void correct(const MembraneStep &step,
               const std::vector<Eigen::Vector3d> &residual);

  const MembraneParameters parameters;
  const SurfaceMesh mesh;
  const MembraneSpace space;
  const Followers midpoints;
  const std::vector<std::vector<std::int32_t>> rims;
  const std::uint64_t identity;
  const Sheet sheet;
  const BatchedSheet batched; ///< the same, for the steps
  std::vector<double> mass;   ///< that of midpoints is with their ends [kg]
  MembraneMotion now;
};
} // namespace fem
