#pragma once

#include "plane_algebra.h"

/// How climbs to the places of contacts go.
namespace dem
{
/// Of a lens, times the radius: what is flatter is climbed like this.
inline constexpr double lowest_curvature = 0.3;
/// Steps below this part of the radius are none.
inline constexpr double converged = 1e-10;

struct Pace
{
  double longest_step = 0.; ///< no step leads farther, of the radius [-]
  int most_steps = 0;       ///< a climb that takes more leads nowhere
  /// A lens more curved than this, over the radius, is taken as it is [-].
  double hill = lowest_curvature;

  /// The curvatures that a step goes by; `size` is the radius [m].
  Mat2 trusted(const Mat2 &lens, double size) const
  {
    return smallest_eigenvalue(lens) > hill / size
               ? lens
               : floored(lens, lowest_curvature / size);
  }
};

inline constexpr Pace usual_pace{0.1, 40};
/// Where long steps leap to and fro over a lens.
inline constexpr Pace careful_pace{0.03, 100};
/// Where steps as on a rounder lens would come to the place of a flat one by
/// hundreds.
inline constexpr Pace flat_pace{0.03, 100, 0.009};
} // namespace dem
