#pragma once

#include <dem/vector.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

namespace dem
{
/// Some points sorted into cubic cells. Members of a cell stand in the order of
/// their numbers.
class CellGrid
{
public:
  CellGrid() = default;
  /// Point k has the number numbers[k]. Cells of this size over the bounding
  /// box (coarser where there would be more than eight per point) [m].
  CellGrid(std::span<const Vec3> points, std::span<const std::int32_t> numbers,
           double cell_size);

  /// Calls visit(number, point) for every point of the cells that the box
  /// touches.
  template <class Visit>
  void visit_box(const Vec3 &lower, const Vec3 &upper, Visit &&visit) const;

private:
  std::array<std::int64_t, 3> cell_of(const Vec3 &x) const;

  Vec3 origin = Vec3::Zero();
  double size = 1.;
  std::array<std::int64_t, 3> n = {1, 1, 1};
  std::vector<std::int32_t> start = {0, 0}, member;
  std::vector<Vec3> position;
};

inline std::array<std::int64_t, 3> CellGrid::cell_of(const Vec3 &x) const
{
  std::array<std::int64_t, 3> cell;
  for (int d = 0; d < 3; ++d)
    cell[d] = std::clamp<std::int64_t>(
        static_cast<std::int64_t>(std::floor((x[d] - origin[d]) / size)), 0,
        n[d] - 1);
  return cell;
}

template <class Visit>
void CellGrid::visit_box(const Vec3 &lower, const Vec3 &upper,
                         Visit &&visit) const
{
  const auto from = cell_of(lower), to = cell_of(upper);
  for (std::int64_t z = from[2]; z <= to[2]; ++z)
    for (std::int64_t y = from[1]; y <= to[1]; ++y)
    {
      // Cells side by side along x: so are their members.
      const std::int64_t row = (z * n[1] + y) * n[0];
      const auto first = static_cast<std::size_t>(row + from[0]),
                 end = static_cast<std::size_t>(row + to[0] + 1);
      for (std::int32_t m = start[first]; m < start[end]; ++m)
        visit(member[static_cast<std::size_t>(m)],
              position[static_cast<std::size_t>(m)]);
    }
}
} // namespace dem
