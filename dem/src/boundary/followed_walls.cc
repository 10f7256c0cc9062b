#include "../contact/follow.h"
#include "facet_kernels.h"
#include "facet_ridges.h"

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
  if (is_elsewhere)
    batch.displaced[k] = std::max<std::uint8_t>(batch.displaced[k],
                                                matters ? 1 : displaced_open);
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
  if (is_elsewhere && batch.side_a.is_known(k))
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

/// Notes when a contact with the facet surface must be looked at again.
void note_rest(const ForceContext &context, const FollowedFacets &walls,
               const ContactBatch &batch, std::size_t k,
               const WallContactPoint &found)
{
  const std::size_t i = row_of(batch.a[k]);
  const double radius = mean_radius(context.particles.shape[i]);
  const bool rests = !batch.is_touching(k) &&
                     found.overlap < -kernel::least_resting_gap * radius;
  walls.contact_points.reactivation[k] =
      rests
          ? context.particles.path_length[i] + walls.path_length - found.overlap
          : 0.;
}

/// Contact k with the facet surface, by the search from where it was.
void relocate_one(const ForceContext &context, const FollowedFacets &walls,
                  ContactBatch &batch, std::size_t k, Events &events)
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
               return refine_on_facets(particle, walls.mesh, start);
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
  task.rows = reinterpret_cast<double *>(walls.rows.data());
  task.depth = walls.overlap.data();
  task.particle_path = context.particles.path_length.data();
  task.surface_path = walls.path_length;
  task.corner = surface.triangles.data()->data();
  task.neighbour = walls.mesh.topology.neighbour.data()->data();
  task.position = numbers(surface.position);
  task.velocity = numbers(surface.velocity);
  task.mass = surface.mass.data();
  return task;
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
  const kernel::FacetTask task = facet_task(context, walls, batch);
  const kernel::FollowFacets follow_block = follow_facets();
  const double tolerance = context.parameters.geometry.refresh_tolerance;
  const ForceSum sum = for_blocks(
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
        }
      });
  share_ridges(context, walls, batch);
  return sum;
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
  keep_shares(walls, batch, k);
}
} // namespace dem
