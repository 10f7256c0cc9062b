#include <dem/assert.h>
#include <dem/contact/damage.h>

#include <cmath>
#include <numbers>

namespace dem
{
double cap_slope(double gaussian_curvature)
{
  DEM_ASSERT(gaussian_curvature > 0.);
  return 2. * std::numbers::pi / std::sqrt(gaussian_curvature);
}
} // namespace dem
