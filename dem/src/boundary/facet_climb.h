#pragma once

#include "depth_model.h"

/// From a point of a facet surface up to the deepest one of its neighbourhood.
namespace dem
{
/// A refinement that lacks more than so many times what the model promises does
/// not come there.
inline constexpr double trusted_gains = 2.;

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
  /// WallContactPoint::lead of the contact point whose depth it is to exceed.
  double missing(const WallContactPoint &contact_point, double gain) const
  {
    return depth - contact_point.overlap - gain;
  }
};

/// Up to the deepest point without a step down. One that does not come there
/// is not found; its lead is what it lacks of the goal.
WallContactPoint climb_on_facets(ParticleView &particle, const FacetMesh &mesh,
                                 const WallContactPoint &start,
                                 const Goal &goal = {});

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
} // namespace dem
