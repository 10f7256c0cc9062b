#include "../neighbor/node_list.h"
#include "../neighbor/node_minima.h"
#include "facet_refinement.h"

#include <dem/boundary/wall_contact_points.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace dem
{
namespace
{
constexpr double far = std::numeric_limits<double>::infinity();
constexpr DirectionGrid nodes = RadiusMap::nodes;
/// Where a surface curves between nodes against the rule of
/// NodeGaps::may_hide(), by this part of the radius at most.
constexpr double fine_tolerance = 0.02;
/// Two contact points on a particle nearer than this are one [rad]: a ridge
/// between them drops by 1e-5 of the radius at most.
constexpr double same_point_angle = 0.01;

ParticleView exact_view(const MappedParticlePose &particle)
{
  return {particle.particle.body, particle.position, particle.rotation, 0.};
}

Vec3 node_point(const MappedParticlePose &particle, int node)
{
  return particle.position +
         particle.rotation * (particle.particle.body.scale *
                              particle.particle.map.point(node).cast<double>());
}

/// Calls call(node) for every node whose distance from a wall is least among
/// its neighbours', where the surface between them may come within `skin`
/// [m]; `distance(point, within)` is that of a point, and may be infinite
/// beyond `within`.
template <class Distance, class Call>
void for_nearest_nodes(const MappedParticlePose &particle, double skin,
                       const Distance &distance, const Call &call)
{
  const RadiusMap &map = particle.particle.map;
  const double scale = particle.particle.body.scale;
  const double tolerance = fine_tolerance * mean_radius(particle.particle.body);
  // The node next to a contact point is farther by no more than the surface
  // curves.
  const double range = skin + tolerance + scale * map.sag();
  NodeGaps gaps;
  std::vector<int> seen;
  for (int block = 0; block < RadiusMap::blocks.size(); ++block)
  {
    const int first = RadiusMap::first_node(block);
    const double near = range + scale * map.block_reach(block);
    if (!(distance(node_point(particle, first), near) < near))
      continue;
    for (int down = 0; down < RadiusMap::block_side; ++down)
      for (int right = 0; right < RadiusMap::block_side; ++right)
      {
        const int node = first + down * nodes.n_azimuth + right;
        gaps.set(node, static_cast<float>(
                           distance(node_point(particle, node), range)));
        seen.push_back(node);
      }
  }
  gaps.close();
  for (const int node : seen)
    if (gaps.at(node) < range && gaps.is_least(node) &&
        gaps.at(node) - gaps.may_hide(node) < skin + tolerance)
      call(node);
}

/// Keeps what a search finds, once.
class ContactPointCollector
{
public:
  ContactPointCollector(const MappedParticlePose &of, double within,
                        std::span<const WallContactPoint> old)
      : particle(of), skin(within), known(old)
  {
  }

  void add(const WallContactPoint &contact_point)
  {
    if (!contact_point.is_found)
      ++found.n_lost;
    else if (is_near(contact_point) && !is_in(known, contact_point))
      keep_deepest(contact_point);
  }

  /// Whether a contact point is near for the first time, a known one too.
  bool is_first(const WallContactPoint &contact_point)
  {
    if (!contact_point.is_found || !is_near(contact_point) ||
        is_in(seen, contact_point))
      return false;
    seen.push_back(contact_point);
    return true;
  }

  WallSearchResult take()
  {
    std::stable_sort(
        found.contact_points.begin(), found.contact_points.end(),
        [](const WallContactPoint &one, const WallContactPoint &other)
        { return one.overlap > other.overlap; });
    return std::move(found);
  }

private:
  /// Of those that are one.
  void keep_deepest(const WallContactPoint &contact_point)
  {
    const auto same = std::ranges::find_if(
        found.contact_points, [&contact_point](const WallContactPoint &other)
        { return is_one_contact_point(contact_point, other); });
    if (same == found.contact_points.end())
      found.contact_points.push_back(contact_point);
    else if (contact_point.overlap > same->overlap)
      *same = contact_point;
  }
  bool is_near(const WallContactPoint &contact_point) const
  {
    return contact_point.overlap > -skin &&
           contact_point.overlap <
               deepest_overlap * mean_radius(particle.particle.body);
  }
  static bool is_in(std::span<const WallContactPoint> points,
                    const WallContactPoint &contact_point)
  {
    return std::any_of(points.begin(), points.end(),
                       [&contact_point](const WallContactPoint &other)
                       { return is_one_contact_point(contact_point, other); });
  }

  const MappedParticlePose &particle;
  double skin;
  std::span<const WallContactPoint> known;
  std::vector<WallContactPoint> seen;
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
      // At an edge or vertex the face most nearly facing the point decides.
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

/// Calls call(vertex) for every corner of the triangles round a vertex.
template <class Call>
void for_corners_round(const FacetMesh &mesh, std::int32_t vertex,
                       const Call &call)
{
  const auto at = static_cast<std::size_t>(vertex);
  for (std::int32_t r = mesh.topology.row_start[at];
       r < mesh.topology.row_start[at + 1]; ++r)
    for (const std::int32_t corner :
         mesh.surface.triangles[static_cast<std::size_t>(
             mesh.topology.row_triangle[static_cast<std::size_t>(r)])])
      call(corner);
}

/// Gaps of the vertices of some triangles, and of those next to them, from a
/// particle by its map.
class VertexGaps
{
public:
  VertexGaps(const MappedParticlePose &particle, const FacetMesh &mesh,
             std::span<const std::int32_t> triangles, double range)
  {
    for (const std::int32_t t : triangles)
      for (const std::int32_t v :
           mesh.surface.triangles[static_cast<std::size_t>(t)])
        for_corners_round(mesh, v,
                          [this](std::int32_t corner)
                          { vertices.push_back(corner); });
    std::sort(vertices.begin(), vertices.end());
    vertices.erase(std::unique(vertices.begin(), vertices.end()),
                   vertices.end());
    const std::size_t room = vertices.size() + kernel::map_spare;
    std::vector<float> x(room), y(room), z(room);
    for (std::size_t k = 0; k < vertices.size(); ++k)
    {
      const Vec3 branch =
          mesh.surface.position[static_cast<std::size_t>(vertices[k])] -
          particle.position;
      x[k] = static_cast<float>(branch.x());
      y[k] = static_cast<float>(branch.y());
      z[k] = static_cast<float>(branch.z());
    }
    gaps.resize(room);
    find_gaps(particle.particle, {Vec3::Zero(), particle.rotation}, range,
              {x.data(), y.data(), z.data()}, static_cast<int>(vertices.size()),
              gaps.data());
  }

  float of(std::int32_t vertex) const
  {
    const auto found =
        std::lower_bound(vertices.begin(), vertices.end(), vertex);
    return gaps[static_cast<std::size_t>(found - vertices.begin())];
  }

private:
  std::vector<std::int32_t> vertices; ///< sorted
  std::vector<float> gaps;
};

/// Calls call(triangle, corner) once for every vertex that is deeper in the
/// particle than the others of its triangles, and not farther than `range`.
template <class Call>
void for_deepest_vertices(const MappedParticlePose &particle,
                          const FacetMesh &mesh,
                          std::span<const std::int32_t> triangles, double range,
                          const Call &call)
{
  const VertexGaps gaps(particle, mesh, triangles, range);
  const auto is_deepest = [&](std::int32_t v)
  {
    bool is_least = true;
    for_corners_round(mesh, v,
                      [&](std::int32_t other)
                      { is_least &= gaps.of(other) >= gaps.of(v); });
    return is_least;
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
      if (gaps.of(v) < range && is_deepest(v))
        call(t, c);
    }
}
} // namespace

bool is_one_contact_point(const WallContactPoint &one,
                          const WallContactPoint &other)
{
  return (one.on_particle - other.on_particle).squaredNorm() <
             same_point_angle * same_point_angle &&
         is_one_patch(one.normal, other.normal);
}

WallSearchResult find_on_facets(const MappedParticlePose &particle,
                                const FacetMesh &mesh,
                                std::span<const std::int32_t> triangles,
                                double skin,
                                std::span<const WallContactPoint> known)
{
  ContactPointCollector contact_points(particle, skin, known);
  ParticleView view = exact_view(particle);
  const MeshDistance nearby(mesh.surface, triangles);
  const double range =
      skin + fine_tolerance * mean_radius(particle.particle.body) +
      particle.particle.body.scale * particle.particle.map.sag();
  const auto distance = [&nearby](const Vec3 &x, double within)
  {
    double least = far;
    nearby.nearest(x, within, least);
    return least;
  };
  const auto refine = [&](const WallContactPoint &start)
  {
    const WallContactPoint contact_point = refine_on_facets(view, mesh, start);
    contact_points.add(contact_point);
    if (!contact_points.is_first(contact_point))
      return;
    for (const WallContactPoint &beside :
         contact_points_beside(view, mesh, contact_point, skin))
      contact_points.add(beside);
  };
  for_nearest_nodes(particle, skin, distance,
                    [&](int node)
                    {
                      const Vec3 x = node_point(particle, node);
                      double least = far;
                      const NearestPoint at = nearby.nearest(x, range, least);
                      if (at.triangle < 0)
                        return;
                      WallContactPoint start;
                      start.on_particle = view.towards(x);
                      start.triangle = at.triangle;
                      start.weight = at.weight;
                      refine(start);
                    });
  for_deepest_vertices(
      particle, mesh, triangles, range,
      [&](std::int32_t triangle, std::size_t corner)
      {
        const auto &v =
            mesh.surface.triangles[static_cast<std::size_t>(triangle)];
        WallContactPoint start;
        start.on_particle = view.towards(
            mesh.surface.position[static_cast<std::size_t>(v[corner])]);
        start.triangle = triangle;
        start.weight[corner] = 1.;
        refine(start);
      });
  return contact_points.take();
}

WallSearchResult find_on_drum(const MappedParticlePose &particle,
                              const Drum &drum, DrumPart part, double skin,
                              std::span<const WallContactPoint> known)
{
  ContactPointCollector contact_points(particle, skin, known);
  ParticleView view = exact_view(particle);
  const auto distance = [&](const Vec3 &x, double)
  { return nearest_on_drum(drum, part, x).distance; };
  for_nearest_nodes(
      particle, skin, distance,
      [&](int node)
      {
        WallContactPoint start;
        start.on_particle = view.towards(node_point(particle, node));
        contact_points.add(refine_on_drum(view, drum, part, start));
      });
  return contact_points.take();
}
} // namespace dem
