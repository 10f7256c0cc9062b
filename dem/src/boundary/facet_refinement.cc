#include "facet_refinement.h"

#include "depth_model.h"

#include <dem/boundary/wall_refinement.h>

#include <algorithm>

namespace dem
{
namespace
{
/// Slope of the depth along an edge that counts as zero [-].
constexpr double level = 1e-9;
/// A corner has no part in a point if its weight is below [-].
constexpr double no_weight = 1e-13;
/// Depth that is not worth a step, of the radius [-].
constexpr double no_gain = 1e-10;
/// A step below this part of the radius leads up, but for what two expansions
/// of the surface differ by.
constexpr double surely_up = 5e-3;

/// Towards the outside of the surface.
Vec3 normal_of(const Corners &corner)
{
  return (corner[1] - corner[0]).cross(corner[2] - corner[0]).normalized();
}

/// The same point of the mesh as one of another triangle.
Weights carried(const FacetMesh &mesh, const WallContactPoint &contact_point,
                std::int32_t to)
{
  const auto &from =
      mesh.surface.triangles[static_cast<std::size_t>(contact_point.triangle)];
  const auto &into = mesh.surface.triangles[static_cast<std::size_t>(to)];
  Weights weight{};
  for (std::size_t c = 0; c < 3; ++c)
    for (std::size_t d = 0; d < 3; ++d)
      if (into[d] == from[c])
        weight[d] = contact_point.weight[c];
  return weight;
}

/// Calls call(triangle) for the triangles round a vertex.
template <class Call>
void for_round(const FacetTopology &topology, std::int32_t vertex,
               const Call &call)
{
  const auto v = static_cast<std::size_t>(vertex);
  for (std::int32_t r = topology.row_start[v]; r < topology.row_start[v + 1];
       ++r)
    call(topology.row_triangle[static_cast<std::size_t>(r)]);
}

/// A triangle at the edge or vertex of the contact point into which the depth
/// grows; -1 if there is none.
std::int32_t way_on(const FacetMesh &mesh,
                    const WallContactPoint &contact_point)
{
  const auto own = static_cast<std::size_t>(contact_point.triangle);
  const auto &corner = mesh.surface.triangles[own];
  const auto &w = contact_point.weight;
  std::int32_t best = -1;
  double steepest = level;
  for (std::size_t c = 0; c < 3; ++c)
    if (w[c] == 1.)
    {
      const Vec3 &at =
          mesh.surface.position[static_cast<std::size_t>(corner[c])];
      for_round(mesh.topology, corner[c],
                [&](std::int32_t other)
                {
                  for (const Vec3 &end : corners_of(mesh.surface, other))
                  {
                    const Vec3 along = end - at;
                    const double length = along.norm();
                    const double rise =
                        length > 0. ? -contact_point.normal.dot(along) / length
                                    : 0.;
                    if (rise > steepest)
                    {
                      steepest = rise;
                      best = other;
                    }
                  }
                });
      return best;
    }
  for (std::size_t c = 0; c < 3; ++c)
  {
    const std::int32_t other = mesh.topology.neighbour[own][(c + 1) % 3];
    if (w[c] != 0. || other < 0)
      continue;
    const Vec3 &from =
        mesh.surface.position[static_cast<std::size_t>(corner[(c + 1) % 3])];
    const Vec3 side =
        (mesh.surface.position[static_cast<std::size_t>(corner[(c + 2) % 3])] -
         from)
            .normalized();
    for (const Vec3 &end : corners_of(mesh.surface, other))
    {
      const Vec3 into = (end - from) - (end - from).dot(side) * side;
      const double length = into.norm();
      if (-contact_point.normal.dot(into) > level * length && length > 0.)
        best = other;
    }
  }
  return best;
}

/// Weights that are none become zero.
void snap(Weights &weight)
{
  double sum = 0.;
  for (double &w : weight)
  {
    w = w < no_weight ? 0. : w;
    sum += w;
  }
  for (double &w : weight)
    w /= sum;
}

/// The point of the particle nearest to another point of the mesh; the point of
/// the particle is searched from `on_particle`.
WallContactPoint contact_point_at(ParticleView &particle, const FacetMesh &mesh,
                                  std::int32_t triangle, const Weights &weight,
                                  const Vec3 &on_particle)
{
  WallContactPoint to =
      depth_of(particle, point_at(corners_of(mesh.surface, triangle), weight),
               on_particle);
  to.triangle = triangle;
  to.weight = weight;
  return to;
}

/// A part of the step, if the depth does not decrease.
WallContactPoint climbed(ParticleView &particle, const FacetMesh &mesh,
                         const WallContactPoint &contact_point,
                         const DepthModel &model, const Ascent &ascent)
{
  const double length = ascent.step.norm();
  // By the model it is deeper there; if it is not, half way.
  for (double part = std::min(1., model.longest / length); part > 1e-4;
       part *= 0.5)
  {
    Weights weight;
    for (std::size_t c = 0; c < 3; ++c)
      weight[c] = part == 1.
                      ? ascent.weight[c]
                      : contact_point.weight[c] +
                            part * (ascent.weight[c] - contact_point.weight[c]);
    snap(weight);
    const WallContactPoint next =
        contact_point_at(particle, mesh, contact_point.triangle, weight,
                         particle.towards(model.on_particle +
                                          part * (model.follow * ascent.step)));
    if (next.is_found && (length < surely_up * particle.size() ||
                          next.overlap >= contact_point.overlap))
      return next;
  }
  return {};
}

/// Calls call(triangle) once for every other triangle that has a corner of one.
template <class Call>
void for_beside(const FacetMesh &mesh, std::int32_t triangle, const Call &call)
{
  const auto &own = mesh.surface.triangles[static_cast<std::size_t>(triangle)];
  for (std::size_t c = 0; c < 3; ++c)
    for_round(mesh.topology, own[c],
              [&](std::int32_t other)
              {
                const auto &corner =
                    mesh.surface.triangles[static_cast<std::size_t>(other)];
                // Those at an earlier corner have been called.
                const bool is_known = std::any_of(
                    own.begin(), own.begin() + static_cast<std::ptrdiff_t>(c),
                    [&corner](std::int32_t v) {
                      return std::find(corner.begin(), corner.end(), v) !=
                             corner.end();
                    });
                if (other != triangle && !is_known)
                  call(other);
              });
}

/// How deep a triangle can be in a particle at most, by its distance from the
/// centre [m].
double deepest_by_distance(const ParticleView &particle, const Corners &corner)
{
  const Vec3 &centre = particle.centre();
  return particle.shape().circumscribed_radius -
         (nearest_point(centre, corner).point - centre).norm();
}

/// First guess of where the particle is nearest to a point that is a step from
/// that of the model: by the model where it is near, else along the radius.
Vec3 next_to(const ParticleView &particle, const DepthModel &model,
             const Vec3 &step)
{
  const Vec3 along = model.follow * step;
  return particle.towards(along.squaredNorm() < model.longest * model.longest
                              ? Vec3(model.on_particle + along)
                              : Vec3(model.point + step));
}
} // namespace

std::vector<WallContactPoint>
contact_points_beside(ParticleView &particle, const FacetMesh &mesh,
                      const WallContactPoint &contact_point, double skin)
{
  /// By which the model may err a triangle farther on, of the radius [-].
  constexpr double model_error = 0.02;
  /// Least drop of the ridge between two contact points, of the radius [-]: a
  /// flat hill is climbed to points far apart.
  constexpr double least_drop = 1e-5;
  const DepthModel model(particle, contact_point);
  const auto is_apart = [&](const WallContactPoint &other)
  {
    const Vec3 way = other.point - contact_point.point;
    const double drop =
        std::max(way.dot(model.shape_operator * way),
                 (other.normal - contact_point.normal).norm() * way.norm());
    return drop > 8. * least_drop * particle.size();
  };
  std::vector<WallContactPoint> found;
  for_beside(mesh, contact_point.triangle,
             [&](std::int32_t triangle)
             {
               const Corners corner = corners_of(mesh.surface, triangle);
               if (deepest_by_distance(particle, corner) < -skin)
                 return;
               const Ascent ascent = best_on_triangle(model, corner);
               if (contact_point.overlap + ascent.gain <
                   -skin - model_error * particle.size())
                 return;
               WallContactPoint start;
               start.triangle = triangle;
               start.weight = ascent.weight;
               start.on_particle = next_to(particle, model, ascent.step);
               const WallContactPoint at =
                   refine_on_facets(particle, mesh, start);
               if (at.is_found && is_apart(at))
                 found.push_back(at);
             });
  return found;
}

WallContactPoint refine_on_facets(ParticleView &particle, const FacetMesh &mesh,
                                  const WallContactPoint &start)
{
  Weights first = start.weight;
  snap(first);
  WallContactPoint contact_point = contact_point_at(
      particle, mesh, start.triangle, first, start.on_particle);
  for (int step = 0;
       step < facet_step_control.most_steps && contact_point.is_found; ++step)
  {
    const DepthModel model(particle, contact_point);
    const Ascent ascent = best_on_triangle(
        model, corners_of(mesh.surface, contact_point.triangle));
    if (ascent.step.norm() < converged * particle.size())
    {
      const std::int32_t next = way_on(mesh, contact_point);
      if (next < 0)
      {
        contact_point.is_found =
            ascent.is_summit &&
            contact_point.normal.dot(normal_of(
                corners_of(mesh.surface, contact_point.triangle))) > 0.;
        return contact_point;
      }
      contact_point.weight = carried(mesh, contact_point, next);
      contact_point.triangle = next;
      continue;
    }
    const WallContactPoint next =
        climbed(particle, mesh, contact_point, model, ascent);
    // The flattest hills are climbed by many steps, to where no depth is left.
    if (ascent.gain < no_gain * particle.size() && ascent.is_summit &&
        (step + 1 == facet_step_control.most_steps || !next.is_found))
      return contact_point;
    if (!next.is_found)
      break;
    contact_point = next;
  }
  contact_point.is_found = false;
  return contact_point;
}
} // namespace dem
