#include "subgrade/density.h"

#include <dem/measure/boundary_profile.h>

#include <cmath>
#include <numbers>

namespace spall
{
namespace
{
/// Counter-clockwise from above; a disc has as many corners as its mesh.
std::vector<Eigen::Vector2d> corners_of(const LoadPlateParameters &plate)
{
  const Footprint half = footprint(plate);
  if (plate.form == PlateForm::block)
    return {{-half.half_x, -half.half_y},
            {half.half_x, -half.half_y},
            {half.half_x, half.half_y},
            {-half.half_x, half.half_y}};
  constexpr int n = 32;
  std::vector<Eigen::Vector2d> corners;
  for (int k = 0; k < n; ++k)
  {
    const double angle = 2. * std::numbers::pi * k / n;
    corners.emplace_back(half.half_x * std::cos(angle),
                         half.half_y * std::sin(angle));
  }
  return corners;
}
} // namespace

double solid_fraction_below(const LoadPlateParameters &plate,
                            const dem::ParticleSystem &particles, double low,
                            double high)
{
  constexpr int n_sections = 100;
  const dem::Outline column =
      dem::outline_of(dem::Prism{corners_of(plate), low, high}, n_sections);
  const dem::ProfileWidths widths{0.1 * (high - low), 0.};
  return 1. - dem::boundary_profile(particles, {}, column, widths).porosity;
}
} // namespace spall
