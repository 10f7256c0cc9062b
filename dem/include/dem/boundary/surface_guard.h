#pragma once

#include <dem/boundary/facet_boundary.h>

#include <optional>
#include <string>

namespace dem
{
/// What makes contacts with a facet surface meaningless.
enum class SurfaceFlaw
{
  folded,  ///< two neighbours lie on each other, or one is inside out
  crossed, ///< the surface runs through itself
  left     ///< a particle has its centre on the wrong side
};

/// Where it is, for the message.
struct SurfaceFault
{
  SurfaceFlaw flaw = SurfaceFlaw::folded;
  std::int32_t first = -1; ///< facet
  std::int32_t second =
      -1; ///< the other facet; the id of the particle that left
  Vec3 position = Vec3::Zero(); ///< there [m]
};

/// Normals of neighbours that turn by more are folded: as sharp as a wedge of
/// 30 degrees [-].
inline constexpr double cos_folded = -0.86602540378443865;

/// First edge whose facets are folded; a facet that is inside out in its plane
/// is one, a facet without area is none.
std::optional<SurfaceFault> find_fold(const FacetMesh &mesh);

/// First facet that an edge of another one passes through; facets that share a
/// vertex do not count. Checks the facets in the cells round each edge.
std::optional<SurfaceFault> find_crossing(const FacetMesh &mesh);

/// First particle whose centre is outside by the angle-weighted normal at the
/// nearest point (Baerentzen and Aanaes 2005), of those no farther from the
/// surface than they reach (wall_bound). Next to a rim there is no outside.
std::optional<SurfaceFault> find_left(const FacetBoundary &facets,
                                      const ParticleSystem &particles,
                                      ContactGeometry geometry);

/// One clause: what, which facets or particle, where.
std::string describe(const SurfaceFault &fault);
} // namespace dem
