#pragma once

#include <fem/solid.h>

#include <vector>

namespace spall
{
/// Where the ground is asked right below the middle of the plate.
class GroundAxis
{
public:
  GroundAxis() = default;
  /// `depths` below the top, of the stresses [m].
  GroundAxis(const fem::SolidMesh &mesh, std::vector<double> depths);

  /// Of the lowest corner of the cells round the axis [m].
  double depth() const { return lowest; }

  /// Heights of the nodes on the axis, and their speeds [m], [m/s].
  std::vector<double> heights(const fem::Solid &ground) const;
  std::vector<double> speeds(const fem::Solid &ground) const;

  /// Vertical stress at the depths, compression positive: mean of the cells
  /// round the axis, between their centres by straight lines [Pa].
  std::vector<double> stresses(const fem::Solid &ground) const;

private:
  std::vector<std::int32_t> nodes;
  std::vector<std::vector<std::size_t>> rings; ///< cells, from the top down
  std::vector<double> ring_depth;              ///< of their centres [m]
  std::vector<double> asked;
  double lowest = 0.;
};
} // namespace spall
