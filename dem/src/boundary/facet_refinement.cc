#include "../contact/newton_step_control.h"

#include <dem/boundary/wall_refinement.h>

#include <algorithm>
#include <limits>

namespace dem
{
namespace
{
/// Hills of the depth over a face are trusted however flat.
constexpr NewtonStepControl control{0.1, 80, least_curvature};
/// Slope of the depth along an edge that counts as zero [-].
constexpr double level = 1e-9;
/// A corner has no part in a point if its weight is below [-].
constexpr double no_weight = 1e-13;
/// A ring of equal maxima is level along itself: this part of the least
/// curvature that steps trust counts as round-off [-].
constexpr double level_curvature = 0.1;
/// Depth that is not worth a step, of the radius [-].
constexpr double no_gain = 1e-10;
/// A step below this part of the radius leads up, but for what two expansions
/// of the surface differ by.
constexpr double surely_up = 5e-3;

using Corners = std::array<Vec3, 3>;
using Weights = std::array<double, 3>;

Vec3 point_at(const Corners &corner, const Weights &weight)
{
  return weight[0] * corner[0] + weight[1] * corner[1] + weight[2] * corner[2];
}

/// Towards the outside of the surface.
Vec3 normal_of(const Corners &corner)
{
  return (corner[1] - corner[0]).cross(corner[2] - corner[0]).normalized();
}

/// The depth about a point y: D(y + z) = D(y) - n.z - z.C z / 2.
struct DepthModel
{
  Vec3 point, normal;
  Mat3 shape_operator; ///< C = K (I - delta K)^-1 [1/m]
  Mat3 follow;      ///< of the point of the particle: (I - delta K)^-1 across n
  Vec3 on_particle; ///< that point [m]
  Mat3 trusted;     ///< C as steps take it: the depth falls off all round
  double least = 0.;   ///< curvature that a step trusts [1/m]
  double longest = 0.; ///< largest step of the model [m]

  DepthModel(ParticleView &particle, const WallContactPoint &contact_point)
      : point(contact_point.point), normal(contact_point.normal),
        least(control.hill / particle.size()),
        longest(control.longest_step * particle.size())
  {
    const SurfacePoint &at = particle.at(contact_point.on_particle);
    on_particle = at.position;
    const Frame frame = tangents(normal);
    const Mat2 k = frame.transpose() * at.shape_operator * frame;
    const Mat2 inverse =
        floored(Mat2::Identity() - contact_point.overlap * k, lowest_curvature)
            .inverse();
    const Mat2 c = k * inverse;
    follow = frame * inverse * frame.transpose();
    const Mat2 even = 0.5 * (c + c.transpose());
    shape_operator = frame * even * frame.transpose();
    trusted =
        frame * control.trusted(even, particle.size()) * frame.transpose();
  }

  double gain(const Vec3 &z) const
  {
    return -normal.dot(z) - 0.5 * z.dot(trusted * z);
  }
};

/// A point of a triangle that is to be deepest in it.
struct Ascent
{
  Weights weight{};
  Vec3 step = Vec3::Zero(); ///< from the point of the model [m]
  double gain = -std::numeric_limits<double>::infinity(); ///< of depth [m]
  bool is_summit = false; ///< the depth falls off to all sides on the face
};

/// The deepest point of the sides by the model.
Ascent best_on_sides(const DepthModel &model, const Corners &corner)
{
  Ascent best;
  for (std::size_t from = 0; from < 3; ++from)
  {
    const std::size_t to = (from + 1) % 3;
    const Vec3 start = corner[from] - model.point,
               side = corner[to] - corner[from];
    // From the point of the side next to that of the model.
    const double square = side.squaredNorm();
    const double foot = std::clamp(-start.dot(side) / square, 0., 1.);
    const Vec3 bent = model.trusted * side;
    const double slope =
        -model.normal.dot(side) - (start + foot * side).dot(bent);
    const double curvature = std::max(side.dot(bent), model.least * square);
    const double s = std::clamp(foot + slope / curvature, 0., 1.);
    const Vec3 step = start + s * side;
    const double gain = model.gain(step);
    if (gain <= best.gain)
      continue;
    best.gain = gain;
    best.step = step;
    best.weight = {};
    best.weight[from] = 1. - s;
    best.weight[to] = s;
  }
  return best;
}

/// The deepest point of the triangle by the model.
Ascent best_on_triangle(const DepthModel &model, const Corners &corner)
{
  const Vec3 first = corner[1] - corner[0], second = corner[2] - corner[0];
  const Vec3 area = first.cross(second);
  Frame frame;
  frame.col(0) = first.normalized();
  frame.col(1) = area.cross(first).normalized();
  const Mat2 shape_operator = frame.transpose() * model.shape_operator * frame;
  // The point of the model need not lie in this plane.
  const Vec3 above =
      area * ((corner[0] - model.point).dot(area) / area.squaredNorm());
  const Mat2 hill = frame.transpose() * model.trusted * frame;
  const Vec2 shift =
      floored(hill, model.least)
          .llt()
          .solve(-(frame.transpose() * (model.normal + model.trusted * above)));
  const Vec3 step = above + frame * shift;
  const Vec3 from_corner = model.point + step - corner[0];
  const double over = 1. / area.squaredNorm();
  const double w1 = from_corner.cross(second).dot(area) * over,
               w2 = first.cross(from_corner).dot(area) * over;
  const bool is_summit =
      smallest_eigenvalue(shape_operator) > -level_curvature * model.least;
  Ascent ascent;
  if (w1 >= 0. && w2 >= 0. && w1 + w2 <= 1.)
    ascent = {{1. - w1 - w2, w1, w2}, step, model.gain(step), is_summit};
  else
  {
    ascent = best_on_sides(model, corner);
    ascent.is_summit = true;
  }
  return ascent;
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

/// A refinement that lacks more than so many times what the model promises does
/// not come there.
constexpr double trusted_gains = 2.;

/// Limits of a refinement and the depth that it must reach; else it ends.
struct Goal
{
  Vec3 centre = Vec3::Zero();
  double radius = std::numeric_limits<double>::infinity();
  double depth = -std::numeric_limits<double>::infinity();

  bool is_out_of_reach(const WallContactPoint &contact_point) const
  {
    return (contact_point.point - centre).squaredNorm() > radius * radius;
  }
  /// What a refinement lacks that gains so much from here on;
  /// WallContactPoint:: lead of the contact point whose depth it is to exceed.
  double missing(const WallContactPoint &contact_point, double gain) const
  {
    return depth - contact_point.overlap - gain;
  }
};

/// Up to the deepest point without a step down.
WallContactPoint refine(ParticleView &particle, const FacetMesh &mesh,
                        const WallContactPoint &start, const Goal &goal = {})
{
  Weights first = start.weight;
  snap(first);
  WallContactPoint contact_point = contact_point_at(
      particle, mesh, start.triangle, first, start.on_particle);
  // From the centre: no depth grows faster than the way, grad D = -n.
  contact_point.lead = goal.missing(contact_point, goal.radius);
  contact_point.is_found = contact_point.is_found && !(contact_point.lead > 0.);
  for (int step = 0; step < control.most_steps && contact_point.is_found;
       ++step)
  {
    contact_point.lead = goal.missing(contact_point, 0.);
    if (goal.is_out_of_reach(contact_point))
      break;
    const DepthModel model(particle, contact_point);
    const Ascent ascent = best_on_triangle(
        model, corners_of(mesh.surface, contact_point.triangle));
    if (const double lead =
            goal.missing(contact_point, trusted_gains * ascent.gain);
        lead > 0.)
    {
      contact_point.lead = lead;
      break;
    }
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
        (step + 1 == control.most_steps || !next.is_found))
      return contact_point;
    if (!next.is_found)
      break;
    contact_point = next;
  }
  contact_point.is_found = false;
  return contact_point;
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

/// Whether the triangle has the side or corner that the contact point is on:
/// the depth falls off into it from there.
bool has_contact_point(const FacetMesh &mesh,
                       const WallContactPoint &contact_point,
                       std::int32_t triangle)
{
  const auto &own =
      mesh.surface.triangles[static_cast<std::size_t>(contact_point.triangle)];
  const auto &other =
      mesh.surface.triangles[static_cast<std::size_t>(triangle)];
  for (std::size_t c = 0; c < 3; ++c)
    if (contact_point.weight[c] > 0. &&
        std::find(other.begin(), other.end(), own[c]) == other.end())
      return false;
  return true;
}

/// A lead above this part of the radius need not be known better.
constexpr double enough_lead = 0.02;

/// The deepest contact point of a patch among those on the triangles beside a
/// contact point.
struct DeepestBeside
{
  WallContactPoint deeper; ///< not found if there is none
  /// What the others have less than the contact point at least [m].
  double lead = std::numeric_limits<double>::infinity();
};

/// Direction of about the point of the particle that is next to one a step from
/// that of the model: by the model where it is near, else along the radius.
Vec3 next_to(const ParticleView &particle, const DepthModel &model,
             const Vec3 &step)
{
  const Vec3 along = model.follow * step;
  return particle.towards(along.squaredNorm() < model.longest * model.longest
                              ? Vec3(model.on_particle + along)
                              : Vec3(model.point + step));
}

/// What the depth on the triangle of `start` lacks of the goal at least [m], by
/// a few steps that follow the surface of the particle; not above zero where
/// they cannot tell.
double lead_over(ParticleView &particle, const FacetMesh &mesh,
                 WallContactPoint start, const Goal &goal)
{
  constexpr int most_steps = 8;
  constexpr double short_step = 0.002; // of the radius
  const Corners corner = corners_of(mesh.surface, start.triangle);
  double lead = 0.;
  for (int step = 0; step < most_steps; ++step)
  {
    start.point = point_at(corner, start.weight);
    if (goal.is_out_of_reach(start))
      return lead;
    // The model is that of the point beside it that x is next to.
    const SurfacePoint &at = particle.at(start.on_particle);
    start.normal = at.normal;
    start.overlap = (at.position - start.point).dot(at.normal);
    start.point = at.position - start.overlap * at.normal;
    const DepthModel model(particle, start);
    const Ascent ascent = best_on_triangle(model, corner);
    lead = goal.missing(start, trusted_gains * std::max(0., ascent.gain));
    if (lead > 0. || ascent.step.norm() < short_step * particle.size())
      break;
    start.weight = ascent.weight;
    start.on_particle = next_to(particle, model, ascent.step);
  }
  return lead;
}

/// What a triangle lacks of a depth, as it is no nearer to the centre than this
/// [m].
double lead_by_distance(const ParticleView &particle, const Corners &corner,
                        double depth)
{
  const Vec3 &centre = particle.centre();
  return depth - particle.shape().circumscribed_radius +
         (nearest_point(centre, corner).point - centre).norm();
}

/// Looks for a deeper one where the model has one on this triangle.
void look_beside(ParticleView &particle, const FacetMesh &mesh,
                 const WallContactPoint &contact_point, const DepthModel &model,
                 std::int32_t triangle, DeepestBeside &beside)
{
  const double gain = 1e-10 * particle.size();
  const Corners corner = corners_of(mesh.surface, triangle);
  const double by_distance =
      lead_by_distance(particle, corner, contact_point.overlap);
  if (by_distance > enough_lead * particle.size())
    return;
  const Ascent ascent = best_on_triangle(model, corner);
  if (ascent.gain < gain)
  {
    if (!has_contact_point(mesh, contact_point, triangle))
      beside.lead = std::min(beside.lead, -ascent.gain);
    return;
  }
  if (by_distance > 0.)
  {
    beside.lead = std::min(beside.lead, by_distance);
    return;
  }
  WallContactPoint start = contact_point;
  start.triangle = triangle;
  start.weight = ascent.weight;
  start.on_particle = next_to(particle, model, ascent.step);
  // Farther away the model was wrong.
  const Goal goal{model.point + ascent.step, 0.5 * ascent.step.norm(),
                  contact_point.overlap};
  // What is known of the particle here stays known if nothing is there.
  ParticleView there = particle;
  const double lead = lead_over(there, mesh, start, goal);
  if (lead > 0.)
  {
    beside.lead = std::min(beside.lead, lead);
    return;
  }
  const WallContactPoint found = refine(there, mesh, start, goal);
  if (found.is_found && !is_one_patch(found.normal, contact_point.normal))
    return;
  beside.lead = std::min(beside.lead, found.lead);
  if (found.is_found && found.overlap > contact_point.overlap + 0.1 * gain &&
      (!beside.deeper.is_found || found.overlap > beside.deeper.overlap))
    beside.deeper = found;
}
} // namespace

WallContactPoint deepest_of_patch(ParticleView &particle, const FacetMesh &mesh,
                                  const WallContactPoint &start)
{
  WallContactPoint contact_point = start;
  constexpr int most_switches = 8;
  for (int n = 0; n < most_switches; ++n)
  {
    const DepthModel model(particle, contact_point);
    DeepestBeside beside;
    for_beside(mesh, contact_point.triangle,
               [&](std::int32_t triangle) {
                 look_beside(particle, mesh, contact_point, model, triangle,
                             beside);
               });
    contact_point.lead = std::max(0., beside.lead);
    if (!beside.deeper.is_found)
      break;
    contact_point = beside.deeper;
    contact_point.has_switched = true;
  }
  return contact_point;
}

WallContactPoint refine_on_facets(ParticleView &particle, const FacetMesh &mesh,
                                  const WallContactPoint &start)
{
  const WallContactPoint contact_point = refine(particle, mesh, start);
  return contact_point.is_found
             ? deepest_of_patch(particle, mesh, contact_point)
             : contact_point;
}
} // namespace dem
