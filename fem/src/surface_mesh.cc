#include <fem/surface_mesh.h>

#include <cmath>
#include <numbers>
#include <span>
#include <stdexcept>
#include <string>

namespace fem
{
namespace
{
void require(bool condition, const std::string &message)
{
  if (!condition)
    throw std::invalid_argument(message);
}

/// A closed tube: the ring, counter-clockwise seen from above, at each height.
SurfaceMesh tube(std::span<const Eigen::Vector2d> ring,
                 std::span<const double> heights)
{
  SurfaceMesh mesh;
  for (const double z : heights)
    for (const Eigen::Vector2d &p : ring)
      mesh.nodes.emplace_back(p.x(), p.y(), z);

  const auto n_around = static_cast<std::int32_t>(ring.size());
  const auto n_along = static_cast<std::int32_t>(heights.size()) - 1;
  for (std::int32_t k = 0; k < n_along; ++k)
    for (std::int32_t i = 0; i < n_around; ++i)
    {
      const std::int32_t next = (i + 1) % n_around;
      const std::int32_t low = k * n_around, high = low + n_around;
      mesh.quads.push_back({low + i, low + next, high + next, high + i});
    }
  return mesh;
}

/// n + 1 values from first to last, both hit exactly.
std::vector<double> evenly(double first, double last, int n)
{
  std::vector<double> values;
  for (int i = 0; i <= n; ++i)
    values.push_back(std::lerp(first, last, static_cast<double>(i) / n));
  return values;
}

std::vector<Eigen::Vector2d> rectangle(const std::vector<double> &x,
                                       const std::vector<double> &y)
{
  std::vector<Eigen::Vector2d> ring;
  for (std::size_t i = 0; i + 1 < x.size(); ++i)
    ring.emplace_back(x[i], y.front());
  for (std::size_t j = 0; j + 1 < y.size(); ++j)
    ring.emplace_back(x.back(), y[j]);
  for (std::size_t i = x.size() - 1; i > 0; --i)
    ring.emplace_back(x[i], y.back());
  for (std::size_t j = y.size() - 1; j > 0; --j)
    ring.emplace_back(x.front(), y[j]);
  return ring;
}
} // namespace

SurfaceMesh box_sides(const Eigen::Vector3d &lower,
                      const Eigen::Vector3d &upper, const std::array<int, 3> &n)
{
  require(lower.allFinite() && upper.allFinite() &&
              (upper - lower).minCoeff() > 0.,
          "box_sides: the upper corner must lie above the lower one along "
          "every axis");
  for (const int count : n)
    require(count >= 1, "box_sides: " + std::to_string(count) +
                            " quads along an edge, at least 1 is needed");
  return tube(rectangle(evenly(lower.x(), upper.x(), n[0]),
                        evenly(lower.y(), upper.y(), n[1])),
              evenly(lower.z(), upper.z(), n[2]));
}

SurfaceMesh cylinder_side(double radius, double height, int n_around,
                          int n_along)
{
  require(std::isfinite(radius) && radius > 0., "cylinder_side: radius " +
                                                    std::to_string(radius) +
                                                    " m, must be positive");
  require(std::isfinite(height) && height > 0., "cylinder_side: height " +
                                                    std::to_string(height) +
                                                    " m, must be positive");
  require(n_around >= 3 && n_along >= 1,
          "cylinder_side: at least 3 quads around and 1 along are needed");
  std::vector<Eigen::Vector2d> ring;
  for (int i = 0; i < n_around; ++i)
  {
    const double angle = 2. * std::numbers::pi * i / n_around;
    ring.emplace_back(radius * std::cos(angle), radius * std::sin(angle));
  }
  return tube(ring, evenly(0., height, n_along));
}

std::vector<std::int32_t> nodes_at_height(const SurfaceMesh &mesh,
                                          double height, double tolerance)
{
  std::vector<std::int32_t> found;
  for (std::size_t k = 0; k < mesh.nodes.size(); ++k)
    if (std::abs(mesh.nodes[k].z() - height) < tolerance)
      found.push_back(static_cast<std::int32_t>(k));
  return found;
}
} // namespace fem
