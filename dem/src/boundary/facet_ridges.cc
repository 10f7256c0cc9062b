#include "facet_ridges.h"

#include "../row_of.h"

#include <dem/boundary/facet_boundary.h>

#include <algorithm>
#include <cmath>

namespace dem
{
namespace
{
/// The point of the way from one contact point to another that is least deep,
/// with the particle between them as it is at both.
struct Ridge
{
  double depth = 0.; ///< not above zero: the contact points are apart [m]
  double share = 0.; ///< of the way from the first one [-]
};

/// Of two contact points of depths above zero.
Ridge ridge_between(const ForceContext &context, const FollowedFacets &walls,
                    const ContactBatch &batch, std::size_t first,
                    std::size_t second)
{
  const WallRow &from = walls.rows[first], &to = walls.rows[second];
  if (!is_one_patch(from.normal, to.normal))
    return {};
  const Vec3 way = to.point - from.point;
  const Vec3 in_body =
      context.particles.rotation(row_of(batch.a[first])).transpose() * way;
  const auto curvature = [&](std::size_t k)
  {
    return in_body.dot(batch.side_a.paraboloid(k).vertex.shape_operator *
                       in_body);
  };
  // C d^2: by the curvatures there, and by how much the normal turns [m].
  const double drop = std::max(0.5 * (curvature(first) + curvature(second)),
                               (to.normal - from.normal).norm() * way.norm());
  const auto &ridge = walls.contact_points.ridge;
  const double depth = ridge[first].depth,
               least = std::min(depth, ridge[second].depth);
  if (!(drop > 0.)) // one point
    return {least, 0.5};
  const double share =
      std::clamp(0.5 + (depth - ridge[second].depth) / drop, 0., 1.);
  return {std::min(least, depth - 0.5 * drop * share * share), share};
}

double exponent_of(const ContactBatch &batch)
{
  return batch.layout.law.entry().exponent;
}

/// Overlap of a contact whose force is that of its depth less its shares.
double left_of(const FacetRidge &ridge, double exponent)
{
  return std::pow(std::max(0., std::pow(ridge.depth, exponent) - ridge.force),
                  1. / exponent);
}
} // namespace

void share_ridges(const ForceContext &context, const FollowedFacets &walls,
                  const ContactBatch &batch)
{
  const double exponent = exponent_of(batch);
  std::vector<FacetRidge> &ridge = walls.contact_points.ridge;
  ridge.assign(batch.size(), {});
  for (std::size_t k = 0; k < batch.size(); ++k)
  {
    ridge[k].depth = std::max(0., walls.overlap[k] - batch.overlap_offset[k]);
    if (ridge[k].depth == 0.)
      continue;
    // With the highest ridge alone, so that n contact points have n - 1.
    Ridge highest;
    std::size_t other = k;
    for (std::size_t l = k; l-- > 0 && batch.a[l] == batch.a[k];)
      if (ridge[l].depth > 0.)
        if (const Ridge between = ridge_between(context, walls, batch, k, l);
            between.depth > highest.depth)
        {
          highest = between;
          other = l;
        }
    if (other == k)
      continue;
    const double force = std::pow(highest.depth, exponent);
    for (const auto &[contact, share] :
         {std::pair{k, 1. - highest.share}, std::pair{other, highest.share}})
    {
      ridge[contact].force += share * force;
      ridge[contact].energy += share * force * highest.depth;
    }
  }
  for (std::size_t k = 0; k < batch.size(); ++k)
    if (ridge[k].force > 0.)
      walls.overlap[k] = batch.overlap_offset[k] + left_of(ridge[k], exponent);
}

void keep_shares(const FollowedFacets &walls, const ContactBatch &batch,
                 std::size_t k)
{
  FacetRidge &ridge = walls.contact_points.ridge[k];
  ridge.depth = std::max(0., walls.overlap[k] - batch.overlap_offset[k]);
  if (ridge.depth > 0. && ridge.force > 0.)
    walls.overlap[k] =
        batch.overlap_offset[k] + left_of(ridge, exponent_of(batch));
}

double FacetBoundary::energy_beyond_springs(std::size_t k) const
{
  if (contact_points.ridge.empty() || contact_points.ridge[k].force == 0.)
    return 0.;
  const FacetRidge &ridge = contact_points.ridge[k];
  const double exponent = exponent_of(batch),
               left = std::max(0., batch.overlap[k]);
  if (exponent != 1. && left == 0.)
    return 0.;
  const double stiffness =
      exponent == 1. ? batch.layout.law.constant_spring().stiffness
                     : batch.pressing_force(k) / std::pow(left, exponent);
  return stiffness / (exponent + 1.) *
         (std::pow(ridge.depth, exponent + 1.) - ridge.energy -
          std::pow(left, exponent + 1.));
}
} // namespace dem
