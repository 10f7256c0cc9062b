#pragma once

#include <span>

namespace dem
{
/// What the upper third of the degrees, 3 n > 2 order, adds to r, over the mean
/// radius. A smooth shape that the order resolves has none. Beside an edge the
/// series overshoots in just those degrees (Gibbs); roughness of the particle
/// at the limit of the order counts as well.
struct Ringing
{
  double rms = 0.;     ///< over the directions [-]
  double largest = 0.; ///< over the nodes of the standard rule [-]
};

Ringing ringing(std::span<const double> coefficients);
} // namespace dem
