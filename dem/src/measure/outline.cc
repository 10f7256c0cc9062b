#include <dem/measure/outline.h>

#include <limits>
#include <numeric>

namespace dem
{
namespace
{
using Vec2 = Eigen::Vector2d;
using Side = Outline::Side;

/// Corner of a triangle below the plane z and one above: where their edge cuts.
Vec2 cut_at(const Vec3 &below, const Vec3 &above, double z)
{
  const double share = (z - below.z()) / (above.z() - below.z());
  return (below + share * (above - below)).head<2>();
}
} // namespace

Outline outline_of(const Prism &prism, int n)
{
  std::vector<Side> section;
  for (std::size_t k = 0; k < prism.corners.size(); ++k)
    section.push_back(
        {prism.corners[k], prism.corners[(k + 1) % prism.corners.size()]});
  return {prism.low, prism.high,
          std::vector(static_cast<std::size_t>(n), section)};
}

Outline outline_of(const FacetSurface &tube, double low, double high, int n)
{
  Outline outline{low, high, {}};
  for (int k = 0; k < n; ++k)
  {
    const double z = low + (k + 0.5) * (high - low) / n;
    std::vector<Side> &section = outline.sections.emplace_back();
    for (std::size_t t = 0; t < tube.triangles.size(); ++t)
    {
      const auto corner = corners_of(tube, static_cast<std::int32_t>(t));
      // Round the triangle: from outside, downward on the left.
      std::optional<Vec2> left, right;
      for (std::size_t c = 0; c < 3; ++c)
      {
        const Vec3 &one = corner[c], &other = corner[(c + 1) % 3];
        if (one.z() < z && other.z() >= z)
          right = cut_at(one, other, z);
        else if (one.z() >= z && other.z() < z)
          left = cut_at(other, one, z);
      }
      if (left && right)
        section.push_back({*left, *right});
    }
  }
  return outline;
}

std::vector<double> section_areas(const Outline &outline)
{
  std::vector<double> areas;
  for (const std::vector<Side> &section : outline.sections)
  {
    double twice = 0.;
    for (const auto &[from, to] : section)
      twice += from.x() * to.y() - from.y() * to.x();
    areas.push_back(0.5 * twice);
  }
  return areas;
}

double bulge_of(std::span<const double> section_areas)
{
  const std::size_t n = section_areas.size(), sixth = n / 6;
  if (sixth == 0)
    return std::numeric_limits<double>::quiet_NaN();
  const auto mean = [](std::span<const double> areas)
  {
    return std::accumulate(areas.begin(), areas.end(), 0.) /
           static_cast<double>(areas.size());
  };
  const double ends = 0.5 * (mean(section_areas.first(sixth)) +
                             mean(section_areas.last(sixth)));
  return mean(section_areas.subspan(2 * sixth, n - 4 * sixth)) / ends - 1.;
}
} // namespace dem
