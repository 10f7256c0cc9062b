#pragma once

#include <dem/boundary/drum.h>
#include <dem/boundary/facet_surface.h>

namespace dem
{
/// The lifter of a drum as facets: its tip and both sides, longer than the drum
/// so that its ends are out of reach. Empty without a lifter.
class DrumLifter
{
public:
  DrumLifter() : topology(surface) {}
  explicit DrumLifter(const Drum &drum);

  /// Puts it where the drum stands now.
  void turn(const Drum &drum);

  FacetMesh mesh() const { return {surface, topology}; }
  /// Numbers of its triangles.
  std::span<const std::int32_t> all() const { return numbers; }
  /// The point of it next to another one; there must be a lifter.
  NearestPoint nearest(const Vec3 &point) const;

private:
  FacetSurface surface;
  FacetTopology topology;
  std::vector<std::int32_t> numbers;
};
} // namespace dem
