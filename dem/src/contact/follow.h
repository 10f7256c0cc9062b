#pragma once

#include "surfaces.h"

#include <dem/contact/common_normal.h>

namespace dem
{
RelativePose relative_pose(const ParticleSystem &particles, std::size_t a,
                           std::size_t b);

/// Where contact k of two particles is; the overlap is not filled in.
ContactPoint contact_point_of(const ContactBatch &batch, std::size_t k);

/// Evaluates both sides of contact k there.
void renew_sides(const ForceContext &context, ContactBatch &batch,
                 std::size_t k, const ContactPoint &contact_point);

/// Searches the common normal of contact k from where it was, as carefully as
/// it takes; if there is none left, the contact stays open until the lists are
/// rebuilt. A jump to another contact point is counted, and adds no energy.
/// Returns how far the surfaces are apart, < 0 where they overlap [m].
double relocate_pair(const ForceContext &context, ContactBatch &batch,
                     std::size_t k, RangeSum &sum);
/// The same for the support point towards a wall.
void relocate_wall(const ForceContext &context, ContactBatch &batch,
                   std::size_t k, const WallRow &wall, RangeSum &sum);
} // namespace dem
