#include "triangle_bins.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace dem
{
namespace
{
/// A grid has at most this many cells for a triangle.
constexpr double cells_per_triangle = 8.;

std::size_t index(std::int32_t i)
{
  return static_cast<std::size_t>(i);
}
} // namespace

TriangleBins::TriangleBins(const FacetSurface &surface)
{
  for (std::size_t t = 0; t < surface.triangles.size(); ++t)
  {
    const auto corner = corners_of(surface, static_cast<std::int32_t>(t));
    const Vec3 lower = corner[0].cwiseMin(corner[1]).cwiseMin(corner[2]);
    const Vec3 upper = corner[0].cwiseMax(corner[1]).cwiseMax(corner[2]);
    centre.push_back(0.5 * (lower + upper));
    half_width.push_back(0.5 * (upper - lower));
  }
  if (!centre.empty())
    choose_cells(surface);
  file_triangles();
}

void TriangleBins::choose_cells(const FacetSurface &surface)
{
  constexpr double far = std::numeric_limits<double>::infinity();
  Vec3 lower = Vec3::Constant(far), upper = Vec3::Constant(-far);
  for (const Vec3 &x : surface.position)
  {
    lower = lower.cwiseMin(x);
    upper = upper.cwiseMax(x);
  }
  double sum = 0.;
  for (const Vec3 &half : half_width)
    sum += 2. * half.maxCoeff();
  const auto count = static_cast<double>(centre.size());
  origin = lower;
  size = sum / count;
  const Vec3 extent = upper - lower;
  while ((extent / size + Vec3::Ones()).prod() > cells_per_triangle * count)
    size *= 1.25;
  for (int axis = 0; axis < 3; ++axis)
    n[static_cast<std::size_t>(axis)] =
        1 + static_cast<std::int32_t>(extent[axis] / size);
}

void TriangleBins::file_triangles()
{
  row_start.assign(index(n[0]) * index(n[1]) * index(n[2]) + 1, 0);
  const auto for_triangles = [this](const auto &visit)
  {
    for (std::size_t t = 0; t < centre.size(); ++t)
      for_rows(centre[t] - half_width[t], centre[t] + half_width[t],
               [&](std::size_t cell, std::size_t end)
               {
                 for (; cell < end; ++cell)
                   visit(t, cell);
               });
  };
  for_triangles([this](std::size_t, std::size_t cell)
                { ++row_start[cell + 1]; });
  for (std::size_t cell = 1; cell < row_start.size(); ++cell)
    row_start[cell] += row_start[cell - 1];
  triangle.resize(index(row_start.back()));
  std::vector<std::int32_t> next = row_start;
  for_triangles(
      [&](std::size_t t, std::size_t cell)
      { triangle[index(next[cell]++)] = static_cast<std::int32_t>(t); });
}

void TriangleBins::gather(const Vec3 &x, double reach,
                          std::vector<std::int32_t> &found) const
{
  found.clear();
  const Vec3 around = Vec3::Constant(reach);
  for_rows(x - around, x + around,
           [&](std::size_t cell, std::size_t end)
           {
             for (std::int32_t k = row_start[cell]; k < row_start[end]; ++k)
               if (gap_of_box(triangle[index(k)], x).squaredNorm() <
                   reach * reach)
                 found.push_back(triangle[index(k)]);
           });
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
}

/// The nearest cell to a point anywhere; the last one if it is no number.
TriangleBins::Cell TriangleBins::cell_of(const Vec3 &x) const
{
  Cell cell;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const auto a = static_cast<Eigen::Index>(axis);
    cell[axis] = static_cast<std::int32_t>(
        std::max(0., std::min(double(n[axis] - 1), (x[a] - origin[a]) / size)));
  }
  return cell;
}

/// From x to the box of a triangle.
Vec3 TriangleBins::gap_of_box(std::int32_t triangle_number, const Vec3 &x) const
{
  const std::size_t t = index(triangle_number);
  return ((x - centre[t]).cwiseAbs() - half_width[t]).cwiseMax(0.);
}

template <class Visit>
void TriangleBins::for_rows(const Vec3 &lower, const Vec3 &upper,
                            const Visit &visit) const
{
  const Cell first = cell_of(lower), last = cell_of(upper);
  for (std::int32_t z = first[2]; z <= last[2]; ++z)
    for (std::int32_t y = first[1]; y <= last[1]; ++y)
    {
      const std::size_t row = index(n[0]) * (index(y) + index(n[1]) * index(z));
      visit(row + index(first[0]), row + index(last[0]) + 1);
    }
}
} // namespace dem
