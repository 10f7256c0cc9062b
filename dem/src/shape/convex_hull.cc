#include "convex_hull.h"

#include <dem/random.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

namespace dem::detail
{
namespace
{
using Index = std::size_t;
using Edge = std::pair<Index, Index>;

struct Face
{
  std::array<Index, 3> corner; ///< counter-clockwise from outside
  Vec3 normal;                 ///< unit [-]
  double offset;               ///< [m]
};

/// The point with the largest value.
template <class Measure>
Index farthest(const std::vector<Vec3> &points, const Measure &measure)
{
  Index best = 0;
  for (Index i = 1; i < points.size(); ++i)
    if (measure(points[i]) > measure(points[best]))
      best = i;
  return best;
}

/// Four points in one plane are no case of their own once each is moved by a
/// random part of this share of the extent [-].
constexpr double joggle = 1e-7;

std::vector<Vec3> joggled(std::span<const Vec3> points)
{
  std::vector<Vec3> moved(points.begin(), points.end());
  double extent = 0.;
  for (const Vec3 &point : moved)
    extent = std::max(extent, (point - moved[0]).cwiseAbs().maxCoeff());
  Random random(1);
  for (Vec3 &point : moved)
    for (double &x : point)
      x += joggle * extent * (random.uniform() - 0.5);
  return moved;
}

class Hull
{
public:
  explicit Hull(std::span<const Vec3> all) : points(joggled(all))
  {
    if (!points.empty() && start())
      for (const Index i : mixed_order())
        insert(i);
  }

  double volume() const
  {
    double six = 0.;
    for (const Face &face : faces)
      six += (points[face.corner[0]] - points[0])
                 .dot((points[face.corner[1]] - points[0])
                          .cross(points[face.corner[2]] - points[0]));
    return six / 6.;
  }

private:
  /// A tetrahedron of far points; false if there is none.
  bool start()
  {
    const Index a = farthest(points, [](const Vec3 &p) { return p.x(); });
    const Index b = farthest(points, [&](const Vec3 &p)
                             { return (p - points[a]).squaredNorm(); });
    const Vec3 along = points[b] - points[a];
    const Index c =
        farthest(points, [&](const Vec3 &p)
                 { return (p - points[a]).cross(along).squaredNorm(); });
    const Vec3 normal = along.cross(points[c] - points[a]);
    const Index d = farthest(points, [&](const Vec3 &p)
                             { return std::abs((p - points[a]).dot(normal)); });
    const double height = (points[d] - points[a]).dot(normal);
    if (!(std::abs(height) > 10. * joggle * along.norm() * normal.norm()))
      return false;
    const auto [second, third] = height < 0. ? Edge(b, c) : Edge(c, b);
    add(a, second, third);
    add(a, third, d);
    add(third, second, d);
    add(second, a, d);
    return true;
  }

  /// Far points early: neighbours in the list are neighbours on the surface.
  std::vector<Index> mixed_order() const
  {
    const Index n = points.size();
    Index step = n / 2 * 2 / 3 + 1;
    while (std::gcd(step, n) != 1)
      ++step;
    std::vector<Index> order(n);
    for (Index i = 0; i < n; ++i)
      order[i] = i * step % n;
    return order;
  }

  void add(Index a, Index b, Index c)
  {
    const Vec3 normal =
        (points[b] - points[a]).cross(points[c] - points[a]).normalized();
    faces.push_back({{a, b, c}, normal, normal.dot(points[a])});
  }

  void insert(Index i)
  {
    std::vector<Edge> edges;
    const auto is_visible = [&](const Face &face)
    {
      if (face.normal.dot(points[i]) <= face.offset)
        return false;
      for (Index k = 0; k < 3; ++k)
        edges.emplace_back(face.corner[k], face.corner[(k + 1) % 3]);
      return true;
    };
    faces.erase(std::remove_if(faces.begin(), faces.end(), is_visible),
                faces.end());
    std::sort(edges.begin(), edges.end());
    for (const auto &[from, to] : edges) // the rim has no edge the other way
      if (!std::binary_search(edges.begin(), edges.end(), Edge(to, from)))
        add(from, to, i);
  }

  std::vector<Vec3> points;
  std::vector<Face> faces;
};
} // namespace

double convex_hull_volume(std::span<const Vec3> points)
{
  return Hull(points).volume();
}
} // namespace dem::detail
