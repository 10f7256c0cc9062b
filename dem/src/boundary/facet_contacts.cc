#include "row_table.h"

#include <dem/boundary/facet_contacts.h>

#include <algorithm>
#include <limits>

namespace dem
{
namespace
{
/// How far away the wall of a slot without contact is [m].
constexpr double far_away = 1e9;

const WallRow no_wall{{0., 0., far_away}};

/// Velocity of the surface at one of its points [m/s].
Vec3 velocity_on(const FacetSurface &surface,
                 const FacetContactPoint &contact_point)
{
  Vec3 velocity = Vec3::Zero();
  if (contact_point.triangle < 0)
    return velocity;
  double along = 0.;
  for_shares(surface, contact_point,
             [&](const VertexShare &share)
             {
               const Vec3 &v =
                   surface.velocity[static_cast<std::size_t>(share.vertex)];
               velocity += share.weight * v;
               along += share.along.dot(v);
             });
  if (!contact_point.shares.of.empty())
    velocity +=
        (along - velocity.dot(contact_point.normal)) * contact_point.normal;
  return velocity;
}

/// What a contact meets that has left the patch it was on.
WallRow left_wall(const FacetSurface &surface,
                  const FacetContactPoint &contact_point)
{
  WallRow row;
  row.point = far_away * contact_point.normal;
  row.normal = row.normal_before = contact_point.normal;
  row.velocity = row.velocity_before = velocity_on(surface, contact_point);
  return row;
}

/// Gives each touch the slot whose last direction is nearest to its own, or a
/// free one; a slot without touch opens. Touches beyond the slots are the
/// farthest and are left out.
void assign_slots(const std::vector<NearestFacetPoint> &touches,
                  const ContactBatch &batch,
                  const std::vector<FacetContactPoint> &contact_point,
                  std::size_t first,
                  std::array<std::int32_t, slots_per_particle> &slot_of)
{
  constexpr double same_patch = 0.7; // cosine of 45 degrees
  std::array<bool, slots_per_particle> is_taken{};
  slot_of.fill(-1);
  const std::size_t n =
      std::min<std::size_t>(touches.size(), slots_per_particle);
  for (std::size_t t = 0; t < n; ++t)
  {
    double best = same_patch;
    for (std::size_t s = 0; s < slots_per_particle; ++s)
      if (!is_taken[s] && batch.is_touching(first + s) &&
          touches[t].direction.dot(contact_point[first + s].normal) > best)
      {
        best = touches[t].direction.dot(contact_point[first + s].normal);
        slot_of[t] = static_cast<std::int32_t>(s);
      }
    if (slot_of[t] >= 0)
      is_taken[static_cast<std::size_t>(slot_of[t])] = true;
  }
  for (int pass = 0; pass < 2; ++pass) // free slots first, then reused ones
    for (std::size_t t = 0; t < n; ++t)
      for (std::size_t s = 0; slot_of[t] < 0 && s < slots_per_particle; ++s)
        if (!is_taken[s] && (pass == 1 || !batch.is_touching(first + s)))
        {
          slot_of[t] = static_cast<std::int32_t>(s);
          is_taken[s] = true;
        }
}

/// Nearest points of the triangles of the row that are nearer than `reach`;
/// the others are inactive until they can be, and the row until the first is
/// active.
void find_near(const FacetSurface &surface, const Vec3 &centre, double reach,
               double path_length, FacetCandidates &candidates, std::size_t row,
               std::vector<NearestFacetPoint> &near)
{
  double first_reactivation = std::numeric_limits<double>::infinity();
  const auto end = static_cast<std::size_t>(candidates.row_start[row + 1]);
  for (auto k = static_cast<std::size_t>(candidates.row_start[row]); k < end;
       ++k)
  {
    double &reactivation = candidates.triangle_reactivation[k];
    if (reactivation <= path_length)
    {
      const NearestFacetPoint touch =
          nearest_on_facet(surface, candidates.triangle[k], centre);
      if (touch.distance < reach)
        near.push_back(touch);
      else
        reactivation = path_length + touch.distance - reach;
    }
    first_reactivation = std::min(first_reactivation, reactivation);
  }
  candidates.reactivation[row] = near.empty() ? first_reactivation : 0.;
}

/// Space to work in for one particle.
struct Found
{
  std::vector<NearestFacetPoint> near, touches;
  std::vector<FacetShares> shares; ///< by touch
};

/// Where the particle touches the surface, and who carries it there.
void find_nearest_points(const ForceContext &context, const FacetMesh &mesh,
                         const ContactBatch &batch, std::size_t particle,
                         Found &found)
{
  const ParticleSystem &particles = context.particles;
  const Vec3 &centre = particles.position(particle);
  found.touches = found.near;
  keep_minima(mesh.surface, mesh.topology, centre, found.touches);
  // The radius of a particle that is no sphere turns with its direction.
  const bool is_ball =
      !particles.has_shapes ||
      !traits(context.parameters.geometry.wall_geometry).reads_shape;
  if (is_ball)
    share_patches(
        mesh,
        {centre, particles.radius(particle), batch.layout.law.entry().exponent},
        found.near, found.touches, found.shares);
  else
  {
    found.shares.resize(std::max(found.shares.size(), found.touches.size()));
    for (FacetShares &shares : found.shares)
      shares.clear();
  }
}

/// Where the touch presses; takes no memory once the contact_point has grown.
void set_contact_point(const NearestFacetPoint &touch,
                       const FacetShares &shares,
                       FacetContactPoint &contact_point)
{
  contact_point.triangle = touch.nearest.triangle;
  contact_point.weight = touch.nearest.weight;
  contact_point.normal = touch.direction;
  contact_point.shares.walls = shares.walls;
  contact_point.shares.extra = shares.extra;
  contact_point.shares.of.assign(shares.of.begin(), shares.of.end());
}

/// The wall at a contact_point, as a contact meets it that comes from nowhere
/// else.
WallRow wall_at(const FacetSurface &surface,
                const FacetContactPoint &contact_point)
{
  const Vec3 velocity = velocity_on(surface, contact_point);
  WallRow row{point_at(surface, contact_point),
              contact_point.normal,
              velocity,
              velocity,
              contact_point.normal,
              0.};
  for_shares(surface, contact_point,
             [&](const VertexShare &share)
             {
               row.inverse_mass +=
                   share.along.squaredNorm() /
                   surface.mass[static_cast<std::size_t>(share.vertex)];
             });
  return row;
}

/// Moves the contact in the slot to the touch; returns its wall.
WallRow move_slot(const FacetSurface &surface, const NearestFacetPoint &touch,
                  const FacetShares &shares, bool is_touching,
                  FacetContactPoint &contact_point)
{
  const Vec3 normal_before = contact_point.normal;
  const Vec3 velocity_before =
      is_touching ? velocity_on(surface, contact_point) : Vec3(Vec3::Zero());
  set_contact_point(touch, shares, contact_point);
  WallRow row = wall_at(surface, contact_point);
  if (is_touching)
  {
    row.velocity_before = velocity_before;
    row.normal_before = normal_before;
  }
  row.point = touch.nearest.point;
  return row;
}

/// Walls of all slots of the particle in this row.
void find_row(const ForceContext &context, const FacetMesh &mesh,
              const ContactBatch &batch, std::size_t row, Found &found,
              FacetCandidates &candidates,
              std::vector<FacetContactPoint> &contact_points,
              std::vector<WallRow> &rows, std::vector<double> &extra)
{
  const FacetSurface &surface = mesh.surface;
  if (candidates.reactivation[row] > context.path_length)
    return; // its walls are far
  const auto i = static_cast<std::size_t>(candidates.particle[row]);
  const Vec3 &centre = context.particles.position(i);
  const std::size_t first = row * slots_per_particle;
  // A contact that opens is still evaluated in that step.
  const double reach = wall_bound(context.particles, i,
                                  context.parameters.geometry.wall_geometry) +
                       context.step_path;
  found.near.clear();
  find_near(surface, centre, reach, context.path_length, candidates, row,
            found.near);
  find_nearest_points(context, mesh, batch, i, found);
  const std::vector<NearestFacetPoint> &touches = found.touches;
  std::array<std::int32_t, slots_per_particle> slot_of;
  assign_slots(touches, batch, contact_points, first, slot_of);
  std::array<bool, slots_per_particle> is_used{};
  for (std::size_t t = 0; t < touches.size() && t < slots_per_particle; ++t)
  {
    const auto slot = static_cast<std::size_t>(slot_of[t]);
    is_used[slot] = true;
    rows[first + slot] = move_slot(surface, touches[t], found.shares[t],
                                   batch.is_touching(first + slot),
                                   contact_points[first + slot]);
    extra[first + slot] = found.shares[t].extra;
  }
  for (std::size_t s = 0; s < slots_per_particle; ++s)
    if (!is_used[s])
    {
      rows[first + s] = batch.is_touching(first + s)
                            ? left_wall(surface, contact_points[first + s])
                            : no_wall;
      extra[first + s] = 0.;
    }
}
} // namespace

FacetCandidates
FacetCandidates::select(const std::vector<std::int32_t> &rows) const
{
  FacetCandidates some;
  for (const std::int32_t row : rows)
  {
    some.particle.push_back(particle[static_cast<std::size_t>(row)]);
    if (!reactivation.empty())
      some.reactivation.push_back(reactivation[static_cast<std::size_t>(row)]);
  }
  some.row_start = starts_of(row_start, rows);
  some.triangle = entries_of(triangle, row_start, rows);
  some.triangle_reactivation =
      entries_of(triangle_reactivation, row_start, rows);
  return some;
}

void FacetCandidates::append(const FacetCandidates &more)
{
  append_entries(more.particle, particle);
  append_starts(more.row_start, row_start);
  append_entries(more.triangle, triangle);
  append_entries(more.triangle_reactivation, triangle_reactivation);
  append_entries(more.reactivation, reactivation);
}

FacetContactPoints
FacetContactPoints::select(const std::vector<std::int32_t> &contacts) const
{
  FacetContactPoints some;
  for (const std::int32_t contact : contacts)
  {
    const auto k = static_cast<std::size_t>(contact);
    some.point.push_back(point[k]);
    if (reactivation.empty())
      continue;
    some.reactivation.push_back(reactivation[k]);
    some.ridge.push_back(ridge[k]);
  }
  return some;
}

void FacetContactPoints::append(const FacetContactPoints &more)
{
  append_entries(more.point, point);
  append_entries(more.reactivation, reactivation);
  append_entries(more.ridge, ridge);
}

WallRow facet_row(const FacetSurface &surface, const FacetContactPoint &now,
                  const FacetContactPoint &before)
{
  WallRow row = wall_at(surface, now);
  row.velocity_before = velocity_on(surface, before);
  row.normal_before = before.normal;
  return row;
}

void find_facets(const ForceContext &context, const FacetMesh &mesh,
                 const ContactBatch &batch, FacetCandidates &candidates,
                 std::vector<FacetContactPoint> &contact_points,
                 std::vector<WallRow> &rows, std::vector<double> &extra)
{
  // Rows of a new list are all active, those of a restored one far if inactive.
  const std::size_t n_slots = candidates.particle.size() * slots_per_particle;
  if (rows.size() != n_slots)
    rows.assign(n_slots, no_wall);
  extra.resize(n_slots, 0.);
  const auto n = static_cast<std::int64_t>(candidates.particle.size());
#pragma omp parallel if (n >= 64)
  {
    // Kept by each thread: a step takes no memory.
    static thread_local Found found;
#pragma omp for schedule(static)
    for (std::int64_t row = 0; row < n; ++row)
      find_row(context, mesh, batch, static_cast<std::size_t>(row), found,
               candidates, contact_points, rows, extra);
  }
}
} // namespace dem
