#include "../contact/follow.h"
#include "facet_kernels.h"

#include <dem/boundary/followed_walls.h>
#include <dem/instruction_set.h>

#include <cstddef>

namespace dem
{
namespace
{
/// A contact point farther than this part of the radius from the last is
/// another one.
constexpr double jump = 0.05;

/// Notes where the contact is now: on the paraboloid as an offset from its
/// vertex, else by a new one.
void note_contact_point(const ForceContext &context, ContactBatch &batch,
                        std::size_t k, const Vec3 &on_particle, bool is_renewed)
{
  if (!is_renewed)
  {
    const Paraboloid known = batch.side_a.paraboloid(k);
    const Vec3 w = known.offset_towards(on_particle);
    const double reach =
        context.parameters.geometry.refresh_tolerance * known.height();
    if (on_particle.dot(known.vertex.normal) > 0. &&
        w.squaredNorm() <= reach * reach)
    {
      batch.side_a.set_offset(k, w);
      return;
    }
  }
  renew_side(context, batch, k, true, on_particle);
}

/// What the contacts of one thread add to the sums of all.
struct Events
{
  int n_jumps = 0, n_ended = 0;
  bool has_displaced = false;

  void add_to(ForceSum &sum) const
  {
    sum.n_jumps += n_jumps;
    sum.n_ended += n_ended;
    sum.has_displaced |= has_displaced;
  }
};

/// Contacts that are updated, and whether the lists can wait for their next
/// check where an open one comes to another contact point or to none.
struct Followed
{
  const ForceContext &context;
  ContactBatch &batch;
  Events &events;
  bool can_wait = false;
};

/// ContactBatch::displaced of an open contact that may have come to the contact
/// point of another one: that matters when it closes.
constexpr std::uint8_t displaced_open = 2;

/// Marks a contact that has moved to another contact point.
void note_displaced(const Followed &all, std::size_t k,
                    const WallContactPoint &contact_point, bool is_elsewhere)
{
  ContactBatch &batch = all.batch;
  const bool matters =
      !all.can_wait || batch.is_touching(k) || contact_point.overlap > 0.;
  if (is_elsewhere || contact_point.has_switched)
    batch.displaced[k] = std::max<std::uint8_t>(
        batch.displaced[k], is_elsewhere && !matters ? displaced_open : 1);
  all.events.has_displaced |=
      matters && (is_elsewhere || batch.displaced[k] == displaced_open);
}

/// Refines the contact point of contact k by `refine(particle, start)`; not
/// found if there is none any more.
template <class Refine>
WallContactPoint follow(const Followed &all, std::size_t k,
                        const Refine &refine)
{
  ContactBatch &batch = all.batch;
  if (batch.overlap_offset[k] >= kernel::closed_offset)
    return {};
  const ForceContext &context = all.context;
  const ParticleSystem &particles = context.particles;
  const std::size_t i = row_of(batch.a[k]);
  ParticleView particle(particles.shape[i], particles.position(i),
                        particles.rotation(i),
                        context.parameters.geometry.refresh_tolerance);
  if (batch.side_a.is_known(k))
    particle.start_from(batch.side_a.paraboloid(k));
  const Vec3 start = batch.side_a.contact_point(k);
  const WallContactPoint contact_point = refine(particle, start);
  if (!contact_point.is_found || contact_point.overlap > 0.3 * particle.size())
  {
    all.events.n_ended += batch.is_touching(k);
    all.events.has_displaced |= !all.can_wait || batch.is_touching(k);
    batch.overlap_offset[k] = kernel::closed_offset;
    batch.displaced[k] = 1;
    return {};
  }
  const bool is_elsewhere = (contact_point.on_particle - start).norm() > jump;
  // A deeper contact point of the same patch is reached at the same depth.
  if (is_elsewhere && !contact_point.has_switched && batch.side_a.is_known(k))
  {
    all.events.n_jumps += batch.is_touching(k);
    batch.overlap_offset[k] =
        std::max(0., contact_point.overlap - batch.overlap[k]);
  }
  note_displaced(all, k, contact_point, is_elsewhere);
  note_contact_point(context, batch, k, contact_point.on_particle,
                     particle.is_renewed() || !batch.side_a.is_known(k));
  return contact_point;
}

/// Calls call(first, end, events) for blocks of all contacts, by all threads.
template <class Call>
ForceSum for_blocks(const ContactBatch &batch, const Call &call)
{
  const auto n = static_cast<std::int64_t>(batch.size());
  ForceSum sum;
#pragma omp parallel if (n >= 64)
  {
    Events events;
#pragma omp for schedule(static)
    for (std::int64_t first = 0; first < n; first += kernel::lane_block)
      call(first, std::min(n, first + kernel::lane_block), events);
#pragma omp critical
    events.add_to(sum);
  }
  return sum;
}

/// Contact k with its part of the drum.
void relocate_one(const ForceContext &context, const FollowedDrum &walls,
                  ContactBatch &batch, std::size_t k, Events &events)
{
  const DrumPart part = drum_part(batch, k);
  WallRow &row = walls.rows[row_of(batch.b[k])];
  const WallContactPoint contact_point =
      follow({context, batch, events}, k,
             [&](ParticleView &particle, const Vec3 &on_particle)
             {
               WallContactPoint start;
               start.on_particle = on_particle;
               if (part != DrumPart::lifter)
                 return refine_on_drum(particle, walls.drum, part, start);
               const NearestPoint at = walls.lifter.nearest(row.point);
               start.triangle = at.triangle;
               start.weight = at.weight;
               return refine_on_facets(particle, walls.lifter.mesh(), start);
             });
  // What has lost its contact point opens where it was.
  walls.overlap[row_of(batch.b[k])] = contact_point.overlap;
  if (!contact_point.is_found)
    return;
  WallRow now;
  now.point = contact_point.point;
  now.normal = now.normal_before = contact_point.normal;
  now.velocity = now.velocity_before =
      walls.drum.velocity_at(part, contact_point.point);
  if (batch.is_touching(k))
  {
    now.velocity_before = row.velocity;
    now.normal_before = row.normal;
  }
  row = now;
}

/// A contact looks at the triangles beside it when the depths of its patch may
/// have come nearer to each other by this part of what it is deeper than they
/// are: the rest is left for the error of the model.
constexpr double patch_share = 0.5;
/// But after this part of the radius.
constexpr double longest_patch_path = 0.005;

/// Notes when a contact with the facet surface must be looked at again.
void note_rest(const ForceContext &context, const FollowedFacets &walls,
               const ContactBatch &batch, std::size_t k,
               const WallContactPoint &found)
{
  const std::size_t i = row_of(batch.a[k]);
  const double radius = mean_radius(context.particles.shape[i]);
  double &reactivation = walls.contact_points.reactivation[k],
         &patch_left = walls.contact_points.patch_left[k];
  patch_left = std::min(patch_share * found.lead, longest_patch_path * radius);
  reactivation = 0.;
  if (batch.is_touching(k) ||
      found.overlap >= -kernel::least_resting_gap * radius)
    return;
  // Until the gap may be closed depths come nearer by no more than twice that.
  reactivation =
      context.particles.path_length[i] + walls.path_length - found.overlap;
  patch_left += 2. * found.overlap;
}

/// Contact k with the facet surface, at what refine(particle, start) finds from
/// where it was.
template <class Refine>
void relocate_on_facet(const ForceContext &context, const FollowedFacets &walls,
                       ContactBatch &batch, std::size_t k, Events &events,
                       const Refine &refine)
{
  FacetContactPoint &contact_point = walls.contact_points.point[k];
  const WallContactPoint found =
      follow({context, batch, events, true}, k,
             [&](ParticleView &particle, const Vec3 &on_particle)
             {
               WallContactPoint start;
               start.on_particle = on_particle;
               start.triangle =
                   static_cast<std::int32_t>(contact_point.triangle);
               start.weight = contact_point.weight;
               return refine(particle, start);
             });
  walls.overlap[k] = found.overlap;
  if (!found.is_found)
  {
    // It opens where it was.
    walls.rows[k] = facet_row(walls.mesh.surface, contact_point, contact_point);
    return;
  }
  note_rest(context, walls, batch, k, found);
  const FacetContactPoint now{found.triangle, found.weight, found.normal};
  walls.rows[k] = facet_row(walls.mesh.surface, now, contact_point);
  contact_point = now;
}

/// Contact k with the facet surface, by the search.
void relocate_one(const ForceContext &context, const FollowedFacets &walls,
                  ContactBatch &batch, std::size_t k, Events &events)
{
  relocate_on_facet(context, walls, batch, k, events,
                    [&](ParticleView &particle, const WallContactPoint &start)
                    { return refine_on_facets(particle, walls.mesh, start); });
}

/// Contact k, which has been followed, at the deepest contact point of its
/// patch.
void look_beside(const ForceContext &context, const FollowedFacets &walls,
                 ContactBatch &batch, std::size_t k, Events &events)
{
  const WallRow followed = walls.rows[k];
  relocate_on_facet(context, walls, batch, k, events,
                    [&](ParticleView &particle, WallContactPoint start)
                    {
                      start.point = followed.point;
                      start.normal = followed.normal;
                      start.overlap = walls.overlap[k];
                      start.is_found = true;
                      return deepest_of_patch(particle, walls.mesh, start);
                    });
  walls.rows[k].velocity_before = followed.velocity_before;
  walls.rows[k].normal_before = followed.normal_before;
}

static_assert(sizeof(FacetContactPoint) ==
              kernel::facet_point_row * sizeof(double));
static_assert(offsetof(FacetContactPoint, weight) ==
              kernel::at_weight * sizeof(double));
static_assert(offsetof(FacetContactPoint, normal) ==
              kernel::at_facet_normal * sizeof(double));

template <class Row>
const double *numbers(const std::vector<Row> &rows)
{
  return reinterpret_cast<const double *>(rows.data());
}

kernel::FacetTask facet_task(const ForceContext &context,
                             const FollowedFacets &walls, ContactBatch &batch)
{
  FacetContactPoints &points = walls.contact_points;
  const FacetSurface &surface = walls.mesh.surface;
  kernel::FacetTask task{};
  task.particles = numbers(context.particles.state);
  task.a = batch.a.data();
  task.side = side_view(batch.side_a);
  task.overlap = batch.overlap.data();
  task.overlap_offset = batch.overlap_offset.data();
  task.points = reinterpret_cast<double *>(points.point.data());
  task.reactivation = points.reactivation.data();
  task.patch_left = points.patch_left.data();
  task.rows = reinterpret_cast<double *>(walls.rows.data());
  task.depth = walls.overlap.data();
  task.particle_path = context.particles.path_length.data();
  task.surface_path = walls.path_length;
  task.corner = surface.triangles.data()->data();
  task.neighbour = walls.mesh.topology.neighbour.data()->data();
  task.position = numbers(surface.position);
  task.velocity = numbers(surface.velocity);
  task.mass = surface.mass.data();
  task.spread = walls.spread.data();
  task.time_step = context.adds_loads_only ? 0. : context.time_step;
  return task;
}

/// What the velocities of two neighbouring vertices differ by, the most about
/// each vertex [m/s].
void find_spread(const FacetMesh &mesh, std::vector<double> &spread)
{
  const FacetSurface &surface = mesh.surface;
  spread.assign(surface.velocity.size(), 0.);
  for (std::size_t t = 0; t < surface.triangles.size(); ++t)
    for (std::size_t c = 0; c < 3; ++c)
    {
      // Each side once.
      const std::int32_t other = mesh.topology.neighbour[t][c];
      if (other >= 0 && row_of(other) < t)
        continue;
      const auto &corner = surface.triangles[t];
      const std::size_t from = row_of(corner[c]),
                        to = row_of(corner[(c + 1) % 3]);
      const double square =
          (surface.velocity[to] - surface.velocity[from]).squaredNorm();
      spread[from] = std::max(spread[from], square);
      spread[to] = std::max(spread[to], square);
    }
  for (double &of : spread)
    of = std::sqrt(of);
}

/// That of the instruction set in use.
kernel::FollowFacets follow_facets()
{
  const InstructionSet set = instruction_set();
  return set == InstructionSet::avx512 ? kernel::avx512::follow_facets
         : set == InstructionSet::avx2 ? kernel::avx2::follow_facets
                                       : kernel::baseline::follow_facets;
}
} // namespace

ForceSum relocate_on_drum(const ForceContext &context,
                          const FollowedDrum &walls, ContactBatch &batch)
{
  const std::size_t n_rows = batch.size() * row_of(n_drum_parts);
  walls.rows.resize(n_rows);
  walls.overlap.assign(n_rows, 0.);
  return for_blocks(batch,
                    [&](std::int64_t first, std::int64_t end, Events &events)
                    {
                      for (std::int64_t k = first; k < end; ++k)
                        relocate_one(context, walls, batch,
                                     static_cast<std::size_t>(k), events);
                    });
}

ForceSum relocate_on_facets(const ForceContext &context,
                            const FollowedFacets &walls, ContactBatch &batch)
{
  walls.rows.resize(batch.size());
  walls.overlap.assign(batch.size(), 0.);
  find_spread(walls.mesh, walls.spread);
  const kernel::FacetTask task = facet_task(context, walls, batch);
  const kernel::FollowFacets follow_block = follow_facets();
  const double tolerance = context.parameters.geometry.refresh_tolerance;
  return for_blocks(
      batch,
      [&](std::int64_t first, std::int64_t end, Events &events)
      {
        const kernel::FacetBlock block =
            follow_block(task, first, static_cast<int>(end - first), tolerance);
        for (std::int64_t at = first; at < end; ++at)
        {
          const auto k = static_cast<std::size_t>(at);
          const unsigned bit = 1u << (at - first);
          if ((block.is_lost & bit) != 0)
            relocate_one(context, walls, batch, k, events);
          else if ((block.is_stale & bit) != 0)
            renew_side(context, batch, k, true, batch.side_a.contact_point(k));
          if ((block.is_patch_due & bit) != 0)
            look_beside(context, walls, batch, k, events);
        }
      });
}

void relocate_again(const ForceContext &context, const FollowedDrum &walls,
                    ContactBatch &batch, std::size_t k)
{
  Events events;
  relocate_one(context, walls, batch, k, events);
}

void relocate_again(const ForceContext &context, const FollowedFacets &walls,
                    ContactBatch &batch, std::size_t k)
{
  Events events;
  walls.contact_points.reactivation[k] = 0.;
  relocate_one(context, walls, batch, k, events);
}
} // namespace dem
