#pragma once

#include "membrane_kernel.h"

#include <fem/membrane.h>

namespace fem
{
/// A node that is tied along all axes.
inline constexpr std::uint8_t all_axes = 7;

inline bool is_tied_along(std::uint8_t axes, int component)
{
  return (axes >> component & 1) != 0;
}

/// The components of a vector along the axes that are not tied.
inline Eigen::Vector3d free_part(std::uint8_t axes, Eigen::Vector3d vector)
{
  for (int c = 0; axes != 0 && c < 3; ++c)
    if (is_tied_along(axes, c))
      vector[c] = 0.;
  return vector;
}

/// All that changes with time: what a checkpoint holds. Columns over nodes.
struct MembraneMotion
{
  std::vector<Eigen::Vector3d> position; ///< [m]
  std::vector<Eigen::Vector3d> velocity; ///< [m/s]
  /// Of the last implicit step, if nothing else came since [m/s^2].
  std::vector<Eigen::Vector3d> acceleration;
  std::vector<Eigen::Vector3d> moved; ///< in the step that is open [m]
  std::vector<Eigen::Vector3d> load;  ///< from outside, of last end_step [N]
  /// Axes along which a node is tied: 1 for x, 2 for y, 4 for z, summed.
  std::vector<std::uint8_t> tied;
  std::uint8_t has_acceleration = 0;
  SheetForces forces;   ///< at the positions of the last end_step
  double pressure = 0.; ///< on the outer face [Pa]
  MembraneEnergy done;  ///< works and dissipation; strain, kinetic unused
};

/// Binary, native byte order. `fingerprint` ties the file to one membrane.
void save_motion(std::ostream &out, std::uint64_t fingerprint,
                 const MembraneMotion &motion);

/// Throws std::runtime_error unless the stream holds a whole membrane with
/// this fingerprint and number of nodes.
MembraneMotion load_motion(std::istream &in, std::uint64_t fingerprint,
                           std::size_t n_nodes);

/// Hash of parameters and reference mesh (FNV-1a).
std::uint64_t fingerprint(const MembraneParameters &parameters,
                          const SurfaceMesh &mesh);
} // namespace fem
