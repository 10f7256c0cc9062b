#include "polygon.h"

#include <array>
#include <numeric>

namespace dem::detail
{
namespace
{
using Index = std::size_t;
using Plane = std::array<double, 2>;

/// The corners in the plane of the polygon, which runs counter-clockwise.
std::vector<Plane> flattened(const std::vector<std::int32_t> &corners,
                             const TriangleMesh &mesh)
{
  const auto at = [&](Index k) -> const Vec3 &
  { return mesh.points[Index(corners[k % corners.size()])]; };
  Vec3 normal = Vec3::Zero();
  for (Index k = 1; k + 1 < corners.size(); ++k)
    normal += (at(k) - at(0)).cross(at(k + 1) - at(0));
  int drop = 0; // the axis that the polygon looks along most
  normal.cwiseAbs().maxCoeff(&drop);
  const int a = (drop + 1) % 3, b = (drop + 2) % 3;
  std::vector<Plane> flat(corners.size());
  for (Index k = 0; k < corners.size(); ++k)
    flat[k] = {at(k)[a], normal[drop] < 0. ? -at(k)[b] : at(k)[b]};
  return flat;
}

/// Twice the area of a triangle, above 0 counter-clockwise.
double area(const Plane &a, const Plane &b, const Plane &c)
{
  return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

/// Whether the corner at `k` of the ring can be cut off.
bool is_ear(const std::vector<Plane> &flat, const std::vector<Index> &ring,
            Index k)
{
  const Index n = ring.size();
  const Index before = (k + n - 1) % n, after = (k + 1) % n;
  const Plane &a = flat[ring[before]], &b = flat[ring[k]],
              &c = flat[ring[after]];
  if (!(area(a, b, c) > 0.))
    return false;
  for (Index i = 0; i < n; ++i)
  {
    const Plane &p = flat[ring[i]];
    if (i == before || i == k || i == after || p == a || p == b || p == c)
      continue;
    if (area(a, b, p) >= 0. && area(b, c, p) >= 0. && area(c, a, p) >= 0.)
      return false;
  }
  return true;
}

/// Where a quad is cut: from this corner to the one opposite.
Index diagonal(const std::vector<Plane> &flat,
               const std::vector<std::int32_t> &corners,
               const TriangleMesh &mesh)
{
  const auto is_inside = [&flat](Index k)
  {
    return area(flat[k], flat[k + 1], flat[k + 2]) > 0. &&
           area(flat[k], flat[k + 2], flat[(k + 3) % 4]) > 0.;
  };
  if (is_inside(0) != is_inside(1))
    return is_inside(0) ? 0 : 1;
  const auto length = [&](Index k)
  {
    return (mesh.points[Index(corners[k])] - mesh.points[Index(corners[k + 2])])
        .norm();
  };
  return length(1) < length(0) ? 1 : 0;
}
} // namespace

void add_polygon(const std::vector<std::int32_t> &corners, TriangleMesh &mesh)
{
  const Index n = corners.size();
  const auto add = [&](Index a, Index b, Index c) {
    mesh.triangles.push_back({corners[a], corners[b], corners[c]});
  };
  if (n == 3)
    return add(0, 1, 2);
  const std::vector<Plane> flat = flattened(corners, mesh);
  if (n == 4)
  {
    const Index k = diagonal(flat, corners, mesh);
    add(k, k + 1, k + 2);
    return add(k, k + 2, (k + 3) % 4);
  }
  std::vector<Index> ring(n);
  std::iota(ring.begin(), ring.end(), Index{0});
  // A polygon that crosses itself may have no ear: its rest becomes a fan.
  for (Index k = 0, n_tried = 0; ring.size() > 3 && n_tried < ring.size();)
  {
    const Index size = ring.size();
    k %= size;
    if (!is_ear(flat, ring, k))
    {
      ++k;
      ++n_tried;
      continue;
    }
    add(ring[(k + size - 1) % size], ring[k], ring[(k + 1) % size]);
    ring.erase(ring.begin() + std::ptrdiff_t(k));
    n_tried = 0;
  }
  for (Index k = 2; k < ring.size(); ++k)
    add(ring[0], ring[k - 1], ring[k]);
}
} // namespace dem::detail
