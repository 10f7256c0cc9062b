#pragma once

#include <dem/boundary/facet_surface.h>
#include <dem/measure/region_stress.h>

#include <array>

namespace dem
{
/// The space of a specimen between its platens: horizontal sections at equal
/// distances, section k at low + (k + 1/2) (high - low) / n. The sides of a
/// section close it counter-clockwise seen from above, in any order.
struct Outline
{
  using Side = std::array<Eigen::Vector2d, 2>; ///< its ends [m]

  double low = 0., high = 0.; ///< z of the platens [m]
  std::vector<std::vector<Side>> sections;
};

/// A prism with n sections.
Outline outline_of(const Prism &prism, int n);

/// A tube of triangles, deformed or not, cut at n heights between its platens.
Outline outline_of(const FacetSurface &tube, double low, double high, int n);

/// Of each section [m^2].
std::vector<double> section_areas(const Outline &outline);

/// How much a specimen bulges: mean area of the middle third of its sections
/// over that of the upper and the lower sixth, less one [-]. 0 for a prism,
/// below 0 for a neck; NaN below six sections.
double bulge_of(std::span<const double> section_areas);
} // namespace dem
