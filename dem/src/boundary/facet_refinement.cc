#include "facet_climb.h"

#include <dem/boundary/wall_refinement.h>

#include <algorithm>

namespace dem
{
namespace
{
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
  const WallContactPoint found = climb_on_facets(there, mesh, start, goal);
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
  const WallContactPoint contact_point = climb_on_facets(particle, mesh, start);
  return contact_point.is_found
             ? deepest_of_patch(particle, mesh, contact_point)
             : contact_point;
}
} // namespace dem
