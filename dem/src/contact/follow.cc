#include "follow.h"

#include <algorithm>

namespace dem
{
namespace
{
/// A contact point farther than this part of the radius from the last is
/// another one.
constexpr double jump = 0.05;

/// The particle on one side of contact k.
std::size_t particle_of(const ContactBatch &batch, std::size_t k, bool is_a)
{
  return row_of(is_a ? batch.a[k] : batch.b[k]);
}

/// Sets the overlap from which contact k counts, so that a new contact point
/// takes up no more energy than the old one had.
void renew_overlap_offset(ContactBatch &batch, std::size_t k, double overlap)
{
  batch.overlap_offset[k] = std::max(0., overlap - batch.overlap[k]);
}

/// It stays open until the lists are rebuilt.
void end_contact(ContactBatch &batch, std::size_t k, RangeSum &sum)
{
  sum.n_ended += batch.is_touching(k);
  sum.has_displaced = true;
  batch.overlap_offset[k] = kernel::closed_offset;
  batch.displaced[k] = 1;
}

/// Start of the search for contact k; `towards` if it has no position yet.
Vec3 first_guess(const SideColumns &side, std::size_t k, const Vec3 &towards)
{
  const Triple<double> u = side.direction[k];
  return dot(u, u) > 0. ? side.contact_point(k) : towards;
}
} // namespace

RelativePose relative_pose(const ParticleSystem &particles, std::size_t a,
                           std::size_t b)
{
  const Mat3 to_a = particles.rotation(a).transpose();
  return {to_a * particles.branch(a, b), to_a * particles.rotation(b)};
}

ContactPoint contact_point_of(const ContactBatch &batch, std::size_t k)
{
  return {batch.side_a.contact_point(k), batch.side_b.contact_point(k), 0.,
          true};
}

void renew_sides(const ForceContext &context, ContactBatch &batch,
                 std::size_t k, const ContactPoint &contact_point)
{
  renew_side(context, batch, k, true, contact_point.on_a);
  renew_side(context, batch, k, false, contact_point.on_b);
}

double relocate_pair(const ForceContext &context, ContactBatch &batch,
                     std::size_t k, RangeSum &sum)
{
  const ParticleSystem &particles = context.particles;
  const std::size_t i = particle_of(batch, k, true),
                    j = particle_of(batch, k, false);
  const ParticleShape &a = particles.shape[i], &b = particles.shape[j];
  const ContactPoint start = contact_point_of(batch, k);
  const ContactPoint found =
      refine(a, b, relative_pose(particles, i, j), start);
  if (!found.is_found || found.overlap > deepest_overlap * mean_radius(a))
  {
    end_contact(batch, k, sum);
    return 0.;
  }
  const bool is_jump = (found.on_a - start.on_a).norm() > jump ||
                       (found.on_b - start.on_b).norm() > jump;
  // After an event the contact is where it was, on the new surface.
  if (is_jump)
  {
    sum.n_jumps += batch.is_touching(k);
    sum.has_displaced = true;
    batch.displaced[k] = 1;
    renew_overlap_offset(batch, k, found.overlap);
  }
  renew_sides(context, batch, k, found);
  return -found.overlap;
}

void relocate_wall(const ForceContext &context, ContactBatch &batch,
                   std::size_t k, const WallRow &wall, RangeSum &sum)
{
  const ParticleSystem &particles = context.particles;
  const std::size_t i = particle_of(batch, k, true);
  const Vec3 normal = particles.orientation(i).conjugate() * wall.normal;
  const Vec3 start = first_guess(batch.side_a, k, normal);
  const Support found = find_support(particles.shape[i], normal, start);
  if (!found.is_found)
  {
    end_contact(batch, k, sum);
    return;
  }
  if (batch.side_a.is_known(k) && (found.direction - start).norm() > jump)
  {
    sum.n_jumps += batch.is_touching(k);
    sum.has_displaced = true;
    batch.displaced[k] = 1;
    renew_overlap_offset(
        batch, k,
        found.height - wall.normal.dot(wall.point - particles.position(i)));
  }
  renew_side(context, batch, k, true, found.direction);
}
} // namespace dem
