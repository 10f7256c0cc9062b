#pragma once

#include <fem/solid.h>

#include <iosfwd>
#include <memory>

namespace fem
{
/// A linear body seen through the nodes that are touched: constraint modes of
/// their motion and the slowest modes of the rest when they are held (Craig
/// and Bampton 1968). Equilibrium is exact with any number of inner modes;
/// with all of them the motion is that of the body.
struct CondensedParameters
{
  std::vector<std::int32_t> interface; ///< nodes of the body, ascending
  int n_inner_modes = 0;
  double time_step = 0.; ///< of advance, average acceleration [s]; 0: none
};

class CondensedSolid
{
public:
  /// Takes mesh, materials, supports, dashpots and damping of the body, not
  /// its motion. Throws std::invalid_argument on nodes that hang or layers that
  /// are not linear, and
  /// std::runtime_error if the supports do not hold the body.
  CondensedSolid(const Solid &body, const CondensedParameters &parameters);
  ~CondensedSolid();
  CondensedSolid(CondensedSolid &&) noexcept;

  /// Equilibrium under these loads on the interface [N]; at rest afterwards.
  void settle(std::span<const Eigen::Vector3d> load);
  /// From now on this load acts, until the next is given [N]: the next step
  /// starts with it.
  void set_load(std::span<const Eigen::Vector3d> load);
  /// One implicit step to loads that hold at its end.
  void advance(std::span<const Eigen::Vector3d> load);

  /// Of the nodes of the interface.
  std::span<const Eigen::Vector3d> displacements() const; ///< [m]
  std::span<const Eigen::Vector3d> velocities() const;    ///< [m/s]
  /// Stored, moving, lost and put in since construction; `damping` is all
  /// that is lost, through dashpots too.
  SolidEnergy energy() const;
  std::size_t n_unknowns() const; ///< of the reduced system
  /// Frequencies of the inner modes, ascending [rad/s].
  std::span<const double> inner_frequencies() const;

  void save(std::ostream &out) const; ///< full state, bit for bit
  /// Throws std::runtime_error if the stream ends early or holds another body.
  void load(std::istream &in);

private:
  struct State;
  std::unique_ptr<State> state;
};
} // namespace fem
