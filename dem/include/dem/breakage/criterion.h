#pragma once

#include <dem/breakage/parameters.h>
#include <dem/triple.h>

#include <algorithm>

namespace dem
{
enum class BreakageMode
{
  none,
  cumulative,   ///< mode I: the cumulative factor exceeds one
  instantaneous ///< mode II: the elastic energy exceeds G_c A_i
};

/// The overlap region of one contact as one of its stones sees it.
struct Cap
{
  double area = 0.;   ///< A_i = 2 pi delta / sqrt(K_G) [m^2], Eq. 15
  double volume = 0.; ///< V_i = A_i delta / 2 [m^3], Eq. 16
};

/// `gaussian_curvature` is the stone's own kappa_max kappa_min, both floored
/// [1/m^2]; `overlap` > 0 [m].
Cap cap_of(double overlap, double gaussian_curvature);

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

/// `energy_before`, `energy` are the elastic energies at the old and the new
/// step [J], `fracture_energy` > 0 is G_c A_i of the new step [J].
template <class Real>
DEM_LANE_INLINE DamageStep<Real>
damage_step(const Real &factor, const Real &energy_before, const Real &energy,
            const Real &fracture_energy)
{
  using std::max;
  const Real share = 1. / fracture_energy;
  return {factor + max(Real(0.), Real((energy - energy_before) * share)),
          energy * share};
}

/// Where both conditions hold, the one that takes precedence.
BreakageMode mode_of(const DamageStep<double> &step,
                     ModePrecedence precedence = ModePrecedence::instantaneous);

/// Energy of a contact as the cumulative factor counts it.
template <class Real>
struct CountedEnergy
{
  Real from = Real(0.); ///< what rises above this counts [J]
  /// Where the energy turned last: its maximum while it counts; minus its
  /// minimum while it has fallen and waits [J]
  Real turn = Real(0.);
};

/// Lets pass swings of the energy below the share `hysteresis` = h of it:
/// energy that has fallen from its maximum by more than h of that counts
/// again once it has risen from its minimum by more than h of itself, then all
/// of the rise. Larger swings count in full; with h = 0 all do (Eq. 4).
template <class Real>
DEM_LANE_INLINE CountedEnergy<Real>
count_energy(const Real &turn, const Real &energy, double hysteresis)
{
  using std::abs;
  using std::max;
  using std::min;
  const auto was_counting = turn >= 0.;
  const Real extreme = abs(turn), rest = Real(1. - hysteresis);
  const auto counts = (was_counting && energy >= rest * extreme) ||
                      (!was_counting && rest * energy > extreme);
  const Real lowest = select(was_counting, energy, min(extreme, energy));
  const Real highest = select(was_counting, max(extreme, energy), energy);
  return {select(was_counting || counts, extreme, energy),
          select(counts, highest, -lowest)};
}

/// Eq. 6: mode I takes one off, mode II sets to zero.
double factor_after(BreakageMode mode, double factor);
} // namespace dem
