#pragma once

#include <dem/contact/laws/hertz.h>

#include <numbers>

namespace dem
{
/// Hertz contact with the attraction of Derjaguin, Muller and Toporov (1975)
/// and a finite range h: cohesion of moist fines. Two surfaces that attract
/// each other with the constant stress w / h up to the gap h (Dugdale) do so
/// with A = 2 pi R w (1 - s / h) at the gap s by the Derjaguin approximation,
/// and with the pull-off force 2 pi R w where they overlap. Separation from
/// touch costs pi R w h. A liquid of surface tension gamma that wets at the
/// angle theta has w = 2 gamma cos(theta). Values: w [J/m^2], h [m].
struct Dmt
{
  static constexpr const char *name = "dmt";
  static constexpr double exponent = Hertz::exponent;
  static constexpr bool scales_with_curvature = true;
  static constexpr bool attracts = true;
  using Tangential = ShearAndRolling;

  static std::vector<LawParameter> parameters()
  {
    return {
        {"work_of_adhesion", "J/m^2", 0.1, 0., 1e3,
         "Work of adhesion w of the law dmt. For a liquid it is "
         "2 gamma cos(theta)."},
        {"attraction_range", "m", 1e-5, 1e-9, 1e-2,
         "Range h of the attraction in the law dmt: gap at which it ends."}};
  }

  static double range(const LawValues &values) { return values[1]; }

  /// `overlap` < 0: a gap [m].
  template <class Real>
  DEM_SIMD_INLINE static NormalSpring<Real> spring(const LawValues &values,
                                                   const Prefactors<Real> &of,
                                                   const Real &overlap)
  {
    using std::max;
    using std::min;
    const Real depth = max(overlap, Real(0.));
    NormalSpring<Real> spring = Hertz::spring(values, of, depth);
    const Real pull_off = 2. * std::numbers::pi * values[0] * of.radius;
    // 1 while the surfaces overlap, 0 from the range on, to the last digit.
    const Real share = max(Real(0.), Real((values[1] + min(overlap, Real(0.))) *
                                          (1. / values[1])));
    spring.attraction = share * pull_off;
    spring.force -= spring.attraction;
    spring.energy -= pull_off * (depth + (0.5 * values[1]) * share * share);
    return spring;
  }

  /// Of the part that presses [J].
  template <class Real>
  DEM_SIMD_INLINE static Real energy(const LawValues &values, const Real &force,
                                     const Real &overlap)
  {
    return Hertz::energy(values, force, overlap);
  }
};
} // namespace dem
