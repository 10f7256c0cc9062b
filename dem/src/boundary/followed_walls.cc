#include "../contact/follow.h"

#include <dem/boundary/followed_walls.h>

namespace dem
{
namespace
{
/// A contact point farther than this part of the radius from the last is
/// another one.
constexpr double jump = 0.05;

/// Surface expansion stored for the side of contact k.
RadialExpansion known_expansion(const SideColumns &side, std::size_t k)
{
  const Triple<double> u = side.direction[k], g = side.gradient[k];
  RadialExpansion known;
  known.direction = Vec3(u.x, u.y, u.z).normalized();
  known.radius = side.radius[k];
  known.gradient = Vec3(g.x, g.y, g.z);
  const auto entry = [&side, k](std::size_t c)
  { return static_cast<double>(side.hessian[c][k]); };
  known.hessian << entry(0), entry(3), entry(4), entry(3), entry(1), entry(5),
      entry(4), entry(5), entry(2);
  return known;
}

/// Notes where the contact is now: within the expansion as an offset from its
/// direction, else by a new one.
void note_contact_point(const ForceContext &context, ContactBatch &batch,
                        std::size_t k, const Vec3 &on_particle, bool is_renewed)
{
  const Triple<double> u = batch.side_a.direction[k];
  const Vec3 from(u.x, u.y, u.z);
  const double along = on_particle.dot(from);
  const Vec3 offset = on_particle / along - from;
  const double reach = context.parameters.geometry.refresh_tolerance;
  if (is_renewed || along <= 0. || offset.squaredNorm() > reach * reach)
    renew_side(context, batch, k, true, on_particle);
  else
    batch.side_a.offset.set(k, {offset.x(), offset.y(), offset.z()});
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
    particle.start_from(known_expansion(batch.side_a, k));
  const Vec3 start = batch.side_a.contact_point(k);
  const WallContactPoint contact_point = refine(particle, start);
  if (!contact_point.is_found || contact_point.overlap > 0.3 * particle.size())
  {
    all.events.n_ended += batch.is_touching(k);
    all.events.has_displaced |= !all.can_wait || batch.is_touching(k);
    batch.overlap_offset[k] = kernel::closed_offset;
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

/// Calls call(k, events) for all contacts, by all threads.
template <class Call>
ForceSum for_contacts(const ContactBatch &batch, const Call &call)
{
  const auto n = static_cast<std::int64_t>(batch.size());
  ForceSum sum;
#pragma omp parallel if (n >= 64)
  {
    Events events;
#pragma omp for schedule(static)
    for (std::int64_t k = 0; k < n; ++k)
      call(static_cast<std::size_t>(k), events);
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

/// Contact k with the facet surface.
void relocate_one(const ForceContext &context, const FollowedFacets &walls,
                  ContactBatch &batch, std::size_t k, Events &events)
{
  FacetContactPoint &contact_point = walls.contact_points.point[k];
  double &reactivation = walls.contact_points.reactivation[k];
  const double path_length =
      context.particles.path_length[row_of(batch.a[k])] + walls.path_length;
  walls.overlap[k] = 0.;
  if (path_length < reactivation)
    return;
  const WallContactPoint found =
      follow({context, batch, events, true}, k,
             [&](ParticleView &particle, const Vec3 &on_particle)
             {
               WallContactPoint start;
               start.on_particle = on_particle;
               start.triangle = contact_point.triangle;
               start.weight = contact_point.weight;
               return refine_on_facets(particle, walls.mesh, start);
             });
  if (!found.is_found)
  {
    // It opens where it was.
    walls.rows[k] = facet_row(walls.mesh.surface, contact_point, contact_point);
    return;
  }
  walls.overlap[k] = found.overlap;
  reactivation = batch.is_touching(k) ? 0. : path_length - found.overlap;
  const FacetContactPoint now{found.triangle, found.weight, found.normal};
  walls.rows[k] = facet_row(walls.mesh.surface, now, contact_point);
  contact_point = now;
}
} // namespace

ForceSum relocate_on_drum(const ForceContext &context,
                          const FollowedDrum &walls, ContactBatch &batch)
{
  const std::size_t n_rows = batch.size() * row_of(n_drum_parts);
  walls.rows.resize(n_rows);
  walls.overlap.assign(n_rows, 0.);
  return for_contacts(batch, [&](std::size_t k, Events &events)
                      { relocate_one(context, walls, batch, k, events); });
}

ForceSum relocate_on_facets(const ForceContext &context,
                            const FollowedFacets &walls, ContactBatch &batch)
{
  walls.rows.resize(batch.size());
  walls.overlap.assign(batch.size(), 0.);
  return for_contacts(batch, [&](std::size_t k, Events &events)
                      { relocate_one(context, walls, batch, k, events); });
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
