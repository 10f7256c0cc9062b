#include <fem/solid_mesh.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>
#include <stdexcept>

namespace fem
{
namespace
{
using Point = Eigen::Vector2d;

/// Quads of the plane, corner v at (v & 1, v >> 1).
struct PlaneMesh
{
  std::vector<Point> nodes;
  std::vector<std::array<std::int32_t, 4>> cells;
};

/// On a side of the inner square, whose sides bulge a little so that the rings
/// start smoothly: k runs from the x axis over the corner to the y axis.
Point square_rim(const QuarterCylinder &block, int k)
{
  const int n = block.n_square;
  const double side = 0.55 * block.radius, bulge = 0.12 * block.radius;
  const double t = static_cast<double>(k <= n ? k : 2 * n - k) / n;
  const Point on_side(side + bulge * (1. - t * t) * 0.5, side * t);
  return k <= n ? on_side : Point(on_side.y(), on_side.x());
}

Point circle(const QuarterCylinder &block, double radius, int k)
{
  const double angle = 0.25 * std::numbers::pi * k / block.n_square;
  return {radius * std::cos(angle), radius * std::sin(angle)};
}

/// Inside of the square: between its two free sides and the two axes, by
/// transfinite interpolation (Coons).
Point square_inside(const QuarterCylinder &block, int i, int j)
{
  const int n = block.n_square;
  const double s = static_cast<double>(i) / n, t = static_cast<double>(j) / n;
  const Point right = square_rim(block, j), top = square_rim(block, 2 * n - i);
  const Point corner = square_rim(block, n);
  const Point along_x(s * square_rim(block, 0).x(), 0.);
  const Point along_y(0., t * square_rim(block, 2 * n).y());
  const Point end_x = square_rim(block, 0), end_y = square_rim(block, 2 * n);
  return (1. - t) * along_x + t * top + (1. - s) * along_y + s * right -
         s * (1. - t) * end_x - (1. - s) * t * end_y - s * t * corner;
}

/// Radii from the rim of the square (share 0) over the circle (1) outward [m].
struct Ring
{
  double share = 0.;  ///< of the way from the square to the circle
  double radius = 0.; ///< beyond the circle [m]
};

std::vector<Ring> make_rings(const QuarterCylinder &block)
{
  std::vector<Ring> rings;
  const double sum =
      std::accumulate(block.inner.begin(), block.inner.end(), 0.);
  double share = 0., radius = block.radius;
  for (const double width : block.inner)
    rings.push_back({share += width / sum, 0.});
  for (const double width : block.outer)
    rings.push_back({1., radius += width});
  return rings;
}

PlaneMesh make_plane(const QuarterCylinder &block)
{
  PlaneMesh plane;
  const int n = block.n_square;
  const auto add = [&plane](const Point &x)
  {
    plane.nodes.push_back(x);
    return static_cast<std::int32_t>(plane.nodes.size()) - 1;
  };
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i)
      add(square_inside(block, i, j));
  for (std::int32_t j = 0; j < n; ++j)
    for (std::int32_t i = 0; i < n; ++i)
    {
      const std::int32_t low = j * (n + 1) + i, high = low + n + 1;
      plane.cells.push_back({low, low + 1, high, high + 1});
    }
  std::vector<std::int32_t> last;
  for (std::int32_t k = 0; k <= 2 * n; ++k)
    last.push_back(k <= n ? k * (n + 1) + n : n * (n + 1) + 2 * n - k);
  for (const Ring &ring : make_rings(block))
  {
    std::vector<std::int32_t> next;
    for (int k = 0; k <= 2 * n; ++k)
      next.push_back(
          add(ring.radius > 0.
                  ? circle(block, ring.radius, k)
                  : Point((1. - ring.share) * square_rim(block, k) +
                          ring.share * circle(block, block.radius, k))));
    for (std::size_t k = 0; k + 1 < next.size(); ++k)
      plane.cells.push_back({last[k], next[k], last[k + 1], next[k + 1]});
    last = next;
  }
  return plane;
}

/// Faces that belong to one cell only, from the six of each cell.
std::vector<SolidMesh::Face> free_faces(const SolidMesh &mesh)
{
  constexpr std::size_t corners[6][4] = {{0, 4, 6, 2}, {1, 3, 7, 5},
                                         {0, 1, 5, 4}, {2, 6, 7, 3},
                                         {0, 2, 3, 1}, {4, 5, 7, 6}};
  std::map<std::array<std::int32_t, 4>, std::pair<int, SolidMesh::Face>> found;
  for (std::size_t k = 0; k < mesh.cells.size(); ++k)
    for (const auto &f : corners)
    {
      const auto &cell = mesh.cells[k];
      SolidMesh::Face face{{cell[f[0]], cell[f[1]], cell[f[2]], cell[f[3]]}};
      face.cell = static_cast<std::int32_t>(k);
      std::array<std::int32_t, 4> key = face.corners;
      std::sort(key.begin(), key.end());
      auto &entry = found[key];
      ++entry.first;
      entry.second = face;
    }
  std::vector<SolidMesh::Face> free;
  for (const auto &[key, entry] : found)
    if (entry.first == 1)
      free.push_back(entry.second);
  return free;
}

std::int32_t side_of(const SolidMesh &mesh,
                     const std::array<std::int32_t, 4> &face, double depth)
{
  const auto all = [&](const auto &condition)
  {
    return std::all_of(
        face.begin(), face.end(),
        [&](std::int32_t node)
        { return condition(mesh.nodes[static_cast<std::size_t>(node)]); });
  };
  const double small = 1e-9 * depth;
  if (all([&](const Eigen::Vector3d &x) { return std::abs(x.x()) < small; }))
    return x_lower;
  if (all([&](const Eigen::Vector3d &x) { return std::abs(x.y()) < small; }))
    return y_lower;
  if (all([&](const Eigen::Vector3d &x) { return std::abs(x.z()) < small; }))
    return z_upper;
  if (all([&](const Eigen::Vector3d &x)
          { return std::abs(x.z() + depth) < small; }))
    return z_lower;
  return x_upper;
}

void check(const QuarterCylinder &block)
{
  const auto is_positive = [](const std::vector<double> &widths)
  {
    return std::all_of(widths.begin(), widths.end(),
                       [](double width) { return width > 0.; });
  };
  if (!(block.radius > 0.) || block.n_square < 1 || block.inner.empty() ||
      block.heights.empty() || !is_positive(block.inner) ||
      !is_positive(block.outer) || !is_positive(block.heights))
    throw std::invalid_argument(
        "quarter cylinder: radius, n_square, inner and heights must be given, "
        "and all widths be positive");
}
} // namespace

SolidMesh quarter_cylinder_mesh(const QuarterCylinder &block)
{
  check(block);
  const PlaneMesh plane = make_plane(block);
  const auto n_plane = static_cast<std::int32_t>(plane.nodes.size());
  SolidMesh mesh;
  double depth = 0.;
  const auto add_level = [&]
  {
    for (const Point &x : plane.nodes)
      mesh.nodes.emplace_back(x.x(), x.y(), -depth);
  };
  add_level();
  for (std::int32_t k = 0; k < static_cast<std::int32_t>(block.heights.size());
       ++k)
  {
    depth += block.heights[static_cast<std::size_t>(k)];
    add_level();
    for (const auto &quad : plane.cells)
    {
      std::array<std::int32_t, 8> &cell = mesh.cells.emplace_back();
      for (std::size_t v = 0; v < 4; ++v)
      {
        cell[v + 4] = k * n_plane + quad[v];
        cell[v] = (k + 1) * n_plane + quad[v];
      }
    }
  }
  mesh.layer.assign(mesh.cells.size(), 0);
  mesh.faces = free_faces(mesh);
  for (SolidMesh::Face &face : mesh.faces)
    face.boundary = side_of(mesh, face.corners, depth);
  return mesh;
}

void assign_layers(SolidMesh &mesh, std::span<const double> tops)
{
  if (tops.empty() || !std::is_sorted(tops.begin(), tops.end()))
    throw std::invalid_argument("solid mesh: the tops of the layers must be "
                                "given from below");
  for (std::size_t k = 0; k < mesh.cells.size(); ++k)
  {
    double centre = 0.;
    for (const std::int32_t node : mesh.cells[k])
      centre += mesh.nodes[static_cast<std::size_t>(node)].z() / 8.;
    const auto above = std::upper_bound(tops.begin(), tops.end() - 1, centre);
    mesh.layer[k] = static_cast<std::int32_t>(above - tops.begin());
  }
}

std::vector<double> graded_widths(double first, double growth, double length)
{
  if (!(first > 0.) || !(growth >= 1.) || !(length >= first))
    throw std::invalid_argument("solid mesh: graded widths need first > 0, "
                                "growth >= 1 and length >= first");
  std::vector<double> widths;
  double sum = 0.;
  for (double width = first; sum < length * (1. - 1e-9); width *= growth)
  {
    widths.push_back(width);
    sum += width;
  }
  for (double &width : widths)
    width *= length / sum;
  return widths;
}
} // namespace fem
