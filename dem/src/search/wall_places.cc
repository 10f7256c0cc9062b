#include "node_minima.h"

#include <dem/search/wall_places.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace dem
{
namespace
{
constexpr double far = std::numeric_limits<double>::infinity();
constexpr DirectionGrid nodes = RadiusMap::nodes;
/// Nodes of the first look: every fourth ring and column.
constexpr int stride = 4;
/// A node may be nearer than one of the first look beside it by at most this
/// part of the largest radius; between nodes the gap may be smaller by this.
constexpr double coarse_slack = 0.4, fine_slack = 0.04;
/// Two places on a stone nearer than this are one [rad].
constexpr double one_place = 0.03;

StoneView exact_view(const PosedStone &stone)
{
  return {stone.stone.body, stone.position, stone.rotation, 0.};
}

Vec3 node_point(const PosedStone &stone, int node)
{
  return stone.position +
         stone.rotation * (stone.stone.body.scale *
                           stone.stone.map.point(node).cast<double>());
}

/// Calls call(node) for every node whose distance from a wall is least among
/// its neighbours' and below `range`; `distance` tells that of a point, and may
/// be infinite.
template <class Distance, class Call>
void for_nearest_nodes(const PosedStone &stone, double range,
                       const Distance &distance, const Call &call)
{
  std::vector<double> gap(static_cast<std::size_t>(nodes.size()), far);
  const double slack = coarse_slack * stone.stone.body.circumscribed_radius;
  const auto look = [&](int node)
  { return distance(node_point(stone, node), range); };
  std::vector<int> seen;
  for (int i = 0; i < nodes.n_polar; i += stride)
    for (int k = 0; k < nodes.n_azimuth; k += stride)
      if (distance(node_point(stone, i * nodes.n_azimuth + k), range + slack) <
          range + slack)
        for (int down = 0; down < stride; ++down)
          for (int right = 0; right < stride; ++right)
          {
            const int node = (i + down) * nodes.n_azimuth + k + right;
            gap[static_cast<std::size_t>(node)] = look(node);
            seen.push_back(node);
          }
  for (const int node : seen)
    if (gap[static_cast<std::size_t>(node)] < range && is_least_gap(gap, node))
      call(node);
}

/// Keeps what a search finds, once.
class Places
{
public:
  Places(const PosedStone &of, double within, std::span<const WallPlace> old)
      : stone(of), margin(within), known(old)
  {
  }

  void add(const WallPlace &place)
  {
    const double size = mean_radius(stone.stone.body);
    if (!place.is_found)
      ++found.n_lost;
    else if (place.overlap > -margin &&
             place.overlap < deepest_overlap * size && !is_listed(place))
      found.places.push_back(place);
  }

  WallSearchResult take()
  {
    std::stable_sort(found.places.begin(), found.places.end(),
                     [](const WallPlace &one, const WallPlace &other)
                     { return one.overlap > other.overlap; });
    return std::move(found);
  }

private:
  bool is_listed(const WallPlace &place) const
  {
    const auto is_same = [&place](const WallPlace &other)
    { return is_one_place(place, other); };
    return std::any_of(known.begin(), known.end(), is_same) ||
           std::any_of(found.places.begin(), found.places.end(), is_same);
  }

  const PosedStone &stone;
  double margin;
  std::span<const WallPlace> known;
  WallSearchResult found;
};

/// Distance of a point from some triangles: below zero behind them.
class MeshDistance
{
public:
  MeshDistance(const FacetSurface &of, std::span<const std::int32_t> triangles)
      : surface(of)
  {
    for (const std::int32_t t : triangles)
    {
      const auto &v = surface.triangles[static_cast<std::size_t>(t)];
      Face face;
      face.triangle = t;
      for (std::size_t c = 0; c < 3; ++c)
        face.corner[c] = surface.position[static_cast<std::size_t>(v[c])];
      face.centre = (face.corner[0] + face.corner[1] + face.corner[2]) / 3.;
      for (const Vec3 &corner : face.corner)
        face.radius = std::max(face.radius, (corner - face.centre).norm());
      face.normal = (face.corner[1] - face.corner[0])
                        .cross(face.corner[2] - face.corner[0])
                        .normalized();
      faces.push_back(face);
    }
  }

  /// Nearest point within `range`; triangle -1: there is none.
  NearestPoint nearest(const Vec3 &x, double range, double &distance) const
  {
    NearestPoint best;
    distance = far;
    double least = range, facing = 0.;
    for (const Face &face : faces)
    {
      const Vec3 to_centre = face.centre - x;
      const double bound = least + face.radius;
      if (std::abs(face.normal.dot(to_centre)) > least ||
          to_centre.squaredNorm() > bound * bound)
        continue;
      NearestPoint at = nearest_point(x, face.corner);
      const double apart = (at.point - x).norm();
      if (apart > least * (1. + 1e-12))
        continue;
      // At an edge or vertex the face that is looked at most squarely decides.
      const double towards = face.normal.dot(at.point - x);
      if (apart < least * (1. - 1e-12) || std::abs(towards) > std::abs(facing))
      {
        facing = towards;
        best = at;
        best.triangle = face.triangle;
      }
      least = std::min(least, apart);
    }
    if (best.triangle >= 0)
      distance = facing >= 0. ? least : -least;
    return best;
  }

private:
  struct Face
  {
    std::int32_t triangle = -1;
    std::array<Vec3, 3> corner;
    Vec3 centre, normal;
    double radius = 0.;
  };

  const FacetSurface &surface;
  std::vector<Face> faces;
};

/// How deep a vertex is in the stone, by its map; far outside: -infinity.
double rough_depth(const PosedStone &stone, const Vec3 &vertex, double range)
{
  const Body &body = stone.stone.body;
  const Vec3 branch = vertex - stone.position;
  const double distance = branch.norm();
  if (distance > body.circumscribed_radius + range || distance == 0.)
    return -far;
  const RadiusMap::Look look =
      stone.stone.map.towards(stone.rotation.transpose() * branch);
  return look.cosine * (body.scale * look.radius - distance);
}

/// Calls call(triangle, corner) once for every vertex that is deeper in the
/// stone than the others of its triangles, and not farther than `range`.
template <class Call>
void for_deepest_vertices(const PosedStone &stone, const FacetMesh &mesh,
                          std::span<const std::int32_t> triangles, double range,
                          const Call &call)
{
  const auto depth = [&](std::int32_t v)
  {
    return rough_depth(
        stone, mesh.surface.position[static_cast<std::size_t>(v)], range);
  };
  const auto is_deepest = [&](std::int32_t v, double own)
  {
    const auto at = static_cast<std::size_t>(v);
    for (std::int32_t r = mesh.topology.row_start[at];
         r < mesh.topology.row_start[at + 1]; ++r)
      for (const std::int32_t other :
           mesh.surface.triangles[static_cast<std::size_t>(
               mesh.topology.row_triangle[static_cast<std::size_t>(r)])])
        if (other != v && depth(other) > own)
          return false;
    return true;
  };
  std::vector<std::int32_t> seen;
  for (const std::int32_t t : triangles)
    for (std::size_t c = 0; c < 3; ++c)
    {
      const std::int32_t v =
          mesh.surface.triangles[static_cast<std::size_t>(t)][c];
      if (std::find(seen.begin(), seen.end(), v) != seen.end())
        continue;
      seen.push_back(v);
      const double own = depth(v);
      if (own > -range && is_deepest(v, own))
        call(t, c);
    }
}
} // namespace

bool is_one_place(const WallPlace &one, const WallPlace &other)
{
  return (one.on_stone - other.on_stone).squaredNorm() <
             one_place * one_place &&
         is_one_patch(one.normal, other.normal);
}

WallSearchResult find_on_facets(const PosedStone &stone, const FacetMesh &mesh,
                                std::span<const std::int32_t> triangles,
                                double margin, std::span<const WallPlace> known)
{
  Places places(stone, margin, known);
  StoneView view = exact_view(stone);
  const MeshDistance nearby(mesh.surface, triangles);
  const double range = margin + fine_slack * mean_radius(stone.stone.body);
  const auto distance = [&nearby](const Vec3 &x, double within)
  {
    double least = far;
    nearby.nearest(x, within, least);
    return least;
  };
  for_nearest_nodes(stone, range, distance,
                    [&](int node)
                    {
                      const Vec3 x = node_point(stone, node);
                      double least = far;
                      const NearestPoint at = nearby.nearest(x, range, least);
                      if (at.triangle < 0)
                        return;
                      WallPlace start;
                      start.on_stone = view.towards(x);
                      start.triangle = at.triangle;
                      start.weight = at.weight;
                      places.add(climb_facets(view, mesh, start));
                    });
  for_deepest_vertices(
      stone, mesh, triangles, range,
      [&](std::int32_t triangle, std::size_t corner)
      {
        const auto &v =
            mesh.surface.triangles[static_cast<std::size_t>(triangle)];
        WallPlace start;
        start.on_stone = view.towards(
            mesh.surface.position[static_cast<std::size_t>(v[corner])]);
        start.triangle = triangle;
        start.weight[corner] = 1.;
        places.add(climb_facets(view, mesh, start));
      });
  return places.take();
}

WallSearchResult find_on_drum(const PosedStone &stone, const Drum &drum,
                              DrumPart part, double margin,
                              std::span<const WallPlace> known)
{
  Places places(stone, margin, known);
  StoneView view = exact_view(stone);
  const double range = margin + fine_slack * mean_radius(stone.stone.body);
  const auto distance = [&](const Vec3 &x, double)
  { return nearest_on_drum(drum, part, x).distance; };
  for_nearest_nodes(stone, range, distance,
                    [&](int node)
                    {
                      WallPlace start;
                      start.on_stone = view.towards(node_point(stone, node));
                      places.add(climb_drum(view, drum, part, start));
                    });
  return places.take();
}
} // namespace dem
