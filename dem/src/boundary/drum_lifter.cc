#include <dem/boundary/drum_lifter.h>

#include <limits>
#include <numeric>

namespace dem
{
namespace
{
/// Four edges along the axis, from the root over the tip to the root, each with
/// a lower and an upper end; the normals of the facets point into the lifter.
FacetSurface facets_of(const Drum &drum)
{
  FacetSurface surface;
  if (drum.lifter_height <= 0.)
    return surface;
  for (std::int32_t from = 0; from < 6; from += 2)
  {
    surface.triangles.push_back({from, from + 2, from + 3});
    surface.triangles.push_back({from, from + 3, from + 1});
  }
  surface.position.assign(8, Vec3::Zero());
  const Vec3 out = lifter_direction(drum), side = drum.axis.cross(out);
  const double tip = drum.radius - drum.lifter_height,
               half = 0.5 * drum.lifter_thickness;
  const double u[4] = {drum.radius, tip, tip, drum.radius};
  const double v[4] = {-half, -half, half, half};
  for (std::size_t edge = 0; edge < 4; ++edge)
    for (std::size_t end = 0; end < 2; ++end)
      surface.position[2 * edge + end] =
          drum.centre + u[edge] * out + v[edge] * side +
          (end == 0 ? -drum.length : drum.length) * drum.axis;
  return surface;
}
} // namespace

DrumLifter::DrumLifter(const Drum &drum)
    : surface(facets_of(drum)), topology(surface),
      numbers(surface.triangles.size())
{
  std::iota(numbers.begin(), numbers.end(), 0);
}

void DrumLifter::turn(const Drum &drum)
{
  surface.position = facets_of(drum).position;
}

NearestPoint DrumLifter::nearest(const Vec3 &point) const
{
  NearestPoint best;
  double least = std::numeric_limits<double>::infinity();
  for (const std::int32_t t : numbers)
  {
    const NearestPoint at = nearest_point(point, corners_of(surface, t));
    const double square = (at.point - point).squaredNorm();
    if (square >= least)
      continue;
    least = square;
    best = at;
    best.triangle = t;
  }
  return best;
}
} // namespace dem
