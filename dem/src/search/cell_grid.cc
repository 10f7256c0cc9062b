#include <dem/search/cell_grid.h>

namespace dem
{
CellGrid::CellGrid(std::span<const Vec3> points, double cell_size)
{
  Vec3 lower = Vec3::Zero(), upper = Vec3::Zero();
  if (!points.empty())
    lower = upper = points[0];
  for (const Vec3 &x : points)
  {
    lower = lower.cwiseMin(x);
    upper = upper.cwiseMax(x);
  }
  origin = lower;
  const Vec3 extent = upper - lower;
  size = std::max(cell_size, 1e-3 * extent.maxCoeff());
  const auto count = [&]
  {
    for (int d = 0; d < 3; ++d)
      n[d] = static_cast<std::int64_t>(extent[d] / size) + 1;
    return n[0] * n[1] * n[2];
  };
  while (count() > 8 * static_cast<std::int64_t>(points.size()) + 8)
    size *= 1.3;
  const auto n_cells = static_cast<std::size_t>(n[0] * n[1] * n[2]);
  std::vector<std::int32_t> cell(points.size());
  start.assign(n_cells + 1, 0);
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    const auto c = cell_of(points[i]);
    cell[i] = static_cast<std::int32_t>((c[2] * n[1] + c[1]) * n[0] + c[0]);
    ++start[static_cast<std::size_t>(cell[i]) + 1];
  }
  for (std::size_t c = 0; c < n_cells; ++c)
    start[c + 1] += start[c];
  member.resize(points.size());
  std::vector<std::int32_t> next(start.begin(), start.end() - 1);
  for (std::size_t i = 0; i < points.size(); ++i)
    member[static_cast<std::size_t>(
        next[static_cast<std::size_t>(cell[i])]++)] =
        static_cast<std::int32_t>(i);
}
} // namespace dem
