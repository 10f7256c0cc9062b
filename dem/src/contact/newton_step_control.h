#pragma once

#include "plane_algebra.h"

#include <dem/contact/common_normal.h>

/// How refinements to contact points go.
namespace dem
{
/// Of a lens, times the radius: what is flatter is climbed like this.
inline constexpr double lowest_curvature = 0.3;
/// Times the radius: what is flatter still is no lens, even of a refinement
/// that trusts flat ones.
inline constexpr double least_curvature = 0.03 * lowest_curvature;
/// Steps below this part of the radius are none.
inline constexpr double converged = 1e-10;

struct NewtonStepControl
{
  double longest_step = 0.; ///< longest step, of the radius [-]
  int most_steps = 0;       ///< a refinement that takes more has failed
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

inline constexpr NewtonStepControl usual_step_control{0.1, 40};
/// Where long steps leap to and fro over a lens.
inline constexpr NewtonStepControl careful_step_control{0.03, 100};
/// Where steps as on a rounder lens would come to the contact point of a flat
/// one by hundreds.
inline constexpr NewtonStepControl flat_step_control{0.03, 100,
                                                     least_curvature};

/// A step along each of two surfaces in its tangent plane [m].
struct NormalStep
{
  Vec3 on_a = Vec3::Zero(), on_b = Vec3::Zero();
  double overlap = 0.; ///< delta where the steps lead, to second order [m]
  /// A maximum of the overlap: K_A + K_B - delta K_B K_A is positive.
  bool is_lens = false;
};

/// One Newton step of two points to the common normal. With d = x_A - x_B, t
/// its part across n = n_A and m = n_A + n_B: a - delta K_A a - b = -t and
/// K_A a + K_B b = -m, with K_A + K_B as the step control trusts it for
/// particles of this size [m].
NormalStep step_to_common_normal(const SurfacePoint &a, const SurfacePoint &b,
                                 double size, const NewtonStepControl &control);
} // namespace dem
