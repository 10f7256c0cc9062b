#include <dem/neighbor/cell_grid.h>

namespace dem
{
CellGrid::CellGrid(std::span<const Vec3> points,
                   std::span<const std::int32_t> numbers, double cell_size)
{
  if (numbers.empty())
    return;
  Vec3 lower = points[0], upper = lower;
  for (const Vec3 &point : points)
  {
    lower = lower.cwiseMin(point);
    upper = upper.cwiseMax(point);
  }
  origin = lower;
  const Vec3 extent = upper - lower;
  size = std::max(cell_size, 1e-4 * extent.maxCoeff());
  const auto count = [&]
  {
    for (int d = 0; d < 3; ++d)
      n[d] = static_cast<std::int64_t>(extent[d] / size) + 1;
    return n[0] * n[1] * n[2];
  };
  while (count() > 8 * static_cast<std::int64_t>(numbers.size()) + 8)
    size *= 1.3;
  std::vector<std::int32_t> cell(numbers.size());
  start.assign(static_cast<std::size_t>(n[0] * n[1] * n[2]) + 1, 0);
  for (std::size_t m = 0; m < numbers.size(); ++m)
  {
    const auto c = cell_of(points[m]);
    cell[m] = static_cast<std::int32_t>((c[2] * n[1] + c[1]) * n[0] + c[0]);
    ++start[static_cast<std::size_t>(cell[m]) + 1];
  }
  for (std::size_t c = 1; c < start.size(); ++c)
    start[c] += start[c - 1];
  member.resize(numbers.size());
  position.resize(numbers.size());
  std::vector<std::int32_t> next(start.begin(), start.end() - 1);
  for (std::size_t m = 0; m < numbers.size(); ++m)
  {
    const auto to =
        static_cast<std::size_t>(next[static_cast<std::size_t>(cell[m])]++);
    member[to] = numbers[m];
    position[to] = points[m];
  }
}
} // namespace dem
