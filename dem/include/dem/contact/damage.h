#pragma once

#include <dem/triple.h>

#include <algorithm>

/// History of a contact for the breakage criterion, as pure functions over
/// numbers or SIMD lanes (`Real`).
namespace dem
{
/// A_i / delta = 2 pi / sqrt(K_G) of a corner [m], Eq. 15.
double cap_slope(double gaussian_curvature);

/// One step of Eqs. 4 and 5 for one contact side.
template <class Real>
struct DamageStep
{
  Real factor = Real(0.); ///< cumulative factor after the step [-]
  /// Above one: mode I by the factor, mode II by E_e / (G_c A_i) [-].
  Real energy_ratio = Real(0.);
};

/// `rise` is what the elastic energy has gained in the step [J] (a loss counts
/// as nothing), `energy` what it is now [J], `fracture_energy` > 0 is G_c A_i
/// now [J].
template <class Real>
DEM_SIMD_INLINE DamageStep<Real>
damage_step(const Real &factor, const Real &rise, const Real &energy,
            const Real &fracture_energy)
{
  using std::max;
  const Real share = 1. / fracture_energy;
  return {factor + max(Real(0.), Real(rise * share)), energy * share};
}

/// Where the energy of a contact turned last: its maximum while it counts,
/// minus its minimum while it has fallen and waits [J]. Lets pass cycles of the
/// energy below the share `hysteresis` = h of it: energy that has fallen from
/// its maximum by more than h of that counts again once it has risen from its
/// minimum by more than h of itself, then all of the rise. Larger cycles count
/// in full; with h = 0 all do (Eq. 4).
template <class Real>
DEM_SIMD_INLINE Real reversal_of_energy(const Real &reversal,
                                        const Real &energy, double hysteresis)
{
  using std::abs;
  using std::max;
  using std::min;
  const auto was_counting = reversal >= 0.;
  const Real extreme = abs(reversal), rest = Real(1. - hysteresis);
  return select(was_counting,
                select(energy >= rest * extreme, max(extreme, energy), -energy),
                select(rest * energy > extreme, energy, -min(extreme, energy)));
}

/// What counts of a step that moved the reversal [J]; < 0: nothing. Reversals
/// may be rounded: what one step counts too much the next counts too little.
template <class Real>
DEM_SIMD_INLINE Real counted_rise(const Real &reversal_before,
                                  const Real &reversal)
{
  using std::abs;
  return reversal - abs(reversal_before);
}
} // namespace dem
