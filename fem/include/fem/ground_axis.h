#pragma once

#include <fem/solid.h>

#include <vector>

namespace fem
{
/// Nodes and cells of the ground along the z axis, from the top down: heights,
/// speeds and stresses there.
class GroundAxis
{
public:
  GroundAxis() = default;
  /// `depths` below the top, of the stresses [m].
  GroundAxis(const SolidMesh &mesh, std::vector<double> depths);

  /// Of the lowest corner of the cells round the axis [m].
  double depth() const { return lowest; }

  /// Heights of the nodes on the axis, and their speeds [m], [m/s].
  std::vector<double> heights(const Solid &ground) const;
  std::vector<double> speeds(const Solid &ground) const;

  /// Vertical stress at the depths, compression positive: mean of the cells
  /// round the axis, between their centres by straight lines [Pa].
  std::vector<double> stresses(const Solid &ground) const;

private:
  std::vector<std::int32_t> nodes;
  std::vector<std::vector<std::size_t>> rings; ///< cells, from the top down
  std::vector<double> ring_depth;              ///< of their centres [m]
  std::vector<double> asked;
  double lowest = 0.;
};
} // namespace fem
