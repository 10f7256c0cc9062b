#include <dem/neighbor/space_order.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace dem
{
namespace
{
/// The lowest 21 bits of x with two zeros between them.
std::uint64_t spread(std::uint64_t x)
{
  x &= 0x1fffff;
  x = (x | x << 32) & 0x1f00000000ffff;
  x = (x | x << 16) & 0x1f0000ff0000ff;
  x = (x | x << 8) & 0x100f00f00f00f00f;
  x = (x | x << 4) & 0x10c30c30c30c30c3;
  x = (x | x << 2) & 0x1249249249249249;
  return x;
}

std::int32_t moved(const std::vector<std::int32_t> &new_row,
                   std::int32_t particle)
{
  return new_row[static_cast<std::size_t>(particle)];
}

} // namespace

std::vector<std::int32_t> space_order(const std::vector<Vec3> &position)
{
  std::vector<std::int32_t> order(position.size());
  std::iota(order.begin(), order.end(), 0);
  if (position.empty())
    return order;
  Vec3 lower = position[0], upper = position[0];
  for (const Vec3 &x : position)
  {
    lower = lower.cwiseMin(x);
    upper = upper.cwiseMax(x);
  }
  const Vec3 extent = upper - lower;
  const double finest = extent.maxCoeff() / 0x1fffff;
  const double size =
      std::max({std::cbrt(extent.prod() / static_cast<double>(position.size())),
                finest, 1e-300});
  std::vector<std::uint64_t> code(position.size());
  for (std::size_t i = 0; i < position.size(); ++i)
  {
    const Vec3 cell = (position[i] - lower) / size;
    code[i] = spread(static_cast<std::uint64_t>(cell.x())) |
              spread(static_cast<std::uint64_t>(cell.y())) << 1 |
              spread(static_cast<std::uint64_t>(cell.z())) << 2;
  }
  std::sort(order.begin(), order.end(),
            [&code](std::int32_t i, std::int32_t j)
            {
              const auto code_of = [&code](std::int32_t particle)
              { return code[static_cast<std::size_t>(particle)]; };
              return std::pair(code_of(i), i) < std::pair(code_of(j), j);
            });
  return order;
}

std::vector<std::int32_t> new_rows(const std::vector<std::int32_t> &order)
{
  std::vector<std::int32_t> new_row(order.size());
  for (std::size_t k = 0; k < order.size(); ++k)
    new_row[static_cast<std::size_t>(order[k])] = static_cast<std::int32_t>(k);
  return new_row;
}

void renumber_pairs(const std::vector<std::int32_t> &new_row,
                    ContactBatch &batch)
{
  for (std::size_t k = 0; k < batch.size(); ++k)
  {
    batch.a[k] = moved(new_row, batch.a[k]);
    batch.b[k] = moved(new_row, batch.b[k]);
  }
  batch.rearrange(batch.layout, batch.by_pair());
}

} // namespace dem
