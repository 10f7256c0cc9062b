#pragma once

#include <dem/contact/law.h>

#include <cmath>

namespace dem
{
/// The tangential law (docs/theory/contact.md): Mindlin shear spring with
/// Coulomb slider, rolling spring k_r = k_s R^2 with limit f_r R F_n, dashpot
/// c = 2 beta sqrt(m* k_s), which has what the spring leaves of the Coulomb
/// limit, so nothing while sliding.
struct ShearAndRolling
{
  template <class Real>
  DEM_SIMD_INLINE static TangentialForce<Real>
  advance(const TangentialStep<Real> &step, ContactHistory<Real> &history,
          Losses<Real> &lost)
  {
    using std::sqrt;
    const ContactMotion<Real> &motion = step.motion;
    const ContactCoefficients &pair = step.coefficients;
    const Real limit = pair.friction * step.pressing;
    const SpringStep<Real> shear = advance_spring<Real>(
        {history.shear, history.shear_compliance, step.moved_before},
        motion.normal, step.moved,
        {step.spring.shear_stiffness, step.spring.first_share}, limit);
    const Triple<Real> dashpot =
        (2. * pair.shear_damping) *
        sqrt(motion.reduced_mass * step.spring.shear_stiffness) *
        (motion.velocity - step.opening_rate * motion.normal);
    lost.friction += shear.dissipated;
    if (pair.rolling_friction > 0.)
    {
      const Triple<Real> turn = Real(step.time_step) * motion.spin;
      const SpringStep<Real> rolling = advance_spring<Real>(
          {history.rolling, history.rolling_compliance, turn}, motion.normal,
          turn,
          {step.spring.shear_stiffness * motion.rolling_radius *
               motion.rolling_radius,
           step.spring.first_share},
          pair.rolling_friction * motion.rolling_radius * step.pressing);
      lost.rolling += rolling.dissipated;
      history.rolling = rolling.value;
      history.rolling_compliance = rolling.compliance;
    }
    history.shear = shear.value;
    history.shear_compliance = shear.compliance;
    return {shear.value, share_within(shear.value, dashpot, limit) * dashpot};
  }
};
} // namespace dem
