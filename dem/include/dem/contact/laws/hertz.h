#pragma once

#include <dem/contact/laws/shear_and_rolling.h>

#include <cmath>

namespace dem
{
/// Share of F delta that a Hertz spring stores: F ~ delta^(3/2).
inline constexpr double hertz_energy_share = 0.4;

/// Normal law of Hertz (docs/theory/contact.md): F = C_H delta^(3/2), k_n =
/// 3/2 C_H delta^(1/2), E = 2/5 F delta, k_s = C_s delta^(1/2), with the
/// factors of the elliptic contact of both surfaces.
struct Hertz
{
  static constexpr const char *name = "hertz";
  static constexpr double exponent = 1.5;
  static constexpr bool scales_with_curvature = true;
  static constexpr bool attracts = false;
  using Tangential = ShearAndRolling;

  static std::vector<LawParameter> parameters() { return {}; }

  /// `overlap` >= 0 [m].
  template <class Real>
  DEM_SIMD_INLINE static NormalSpring<Real>
  spring(const LawValues &, const Prefactors<Real> &of, const Real &overlap)
  {
    using std::sqrt;
    const Real root = sqrt(overlap);
    NormalSpring<Real> spring;
    spring.stiffness = exponent * of.normal * root;
    spring.force = of.normal * overlap * root;
    spring.energy = hertz_energy_share * spring.force * overlap;
    spring.shear_stiffness = of.shear * root;
    return spring;
  }

  /// Stored by the spring that presses with `force` at this overlap [J].
  template <class Real>
  DEM_SIMD_INLINE static Real energy(const LawValues &, const Real &force,
                                     const Real &overlap)
  {
    return hertz_energy_share * force * overlap;
  }
};
} // namespace dem
