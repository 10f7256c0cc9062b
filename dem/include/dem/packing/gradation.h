#pragma once

#include <dem/packing/random.h>
#include <dem/shape/body.h>

#include <span>
#include <vector>

namespace dem
{
/// Grading curve by mass: share passing at each diameter, straight in ln(d)
/// between the points; strictly increasing, from 0 to 1.
struct GradingCurve
{
  std::vector<double> diameter; ///< [m]
  std::vector<double> passing;  ///< [-]
};

/// Draws stones, largest first, until their volume is `solid_volume` [m^3] to
/// half a smallest stone. The mass of 40 narrow classes follows the curve; what
/// a class cannot fill goes to the next finer one. The diameter is twice the
/// ball radius; each stone takes one of `shapes` at random (spheres if empty).
/// Throws std::invalid_argument if they are more than ten million.
std::vector<Body>
draw_stones(const GradingCurve &curve, double solid_volume,
            std::span<const std::shared_ptr<const Coefficients>> shapes,
            Random &random);
} // namespace dem
