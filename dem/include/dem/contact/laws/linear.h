#pragma once

#include <dem/contact/laws/shear_and_rolling.h>

namespace dem
{
/// Linear normal law: F = k_n delta, E = k_n delta^2 / 2, constant k_s. Its
/// values are k_n and k_s [N/m].
struct Linear
{
  static constexpr const char *name = "linear";
  static constexpr double exponent = 1.;
  static constexpr bool scales_with_curvature = false;
  static constexpr bool attracts = false;
  using Tangential = ShearAndRolling;

  static std::vector<LawParameter> parameters()
  {
    return {{"normal_stiffness", "N/m", 1e6, 1., 1e12,
             "Normal stiffness k_n of the law linear."},
            {"shear_stiffness", "N/m", 0.85e6, 0., 1e12,
             "Shear stiffness k_s of the law linear."}};
  }

  /// All zero where `overlap` is.
  template <class Real>
  DEM_SIMD_INLINE static NormalSpring<Real>
  spring(const LawValues &values, const Prefactors<Real> &, const Real &overlap)
  {
    const auto is_touching = overlap > 0.;
    NormalSpring<Real> spring;
    spring.stiffness = select(is_touching, Real(values[0]), Real(0.));
    spring.force = values[0] * overlap;
    spring.energy = 0.5 * values[0] * overlap * overlap;
    spring.shear_stiffness = select(is_touching, Real(values[1]), Real(0.));
    spring.first_share = Real(1.);
    return spring;
  }

  template <class Real>
  DEM_SIMD_INLINE static Real energy(const LawValues &values, const Real &,
                                     const Real &overlap)
  {
    return 0.5 * values[0] * overlap * overlap;
  }
};
} // namespace dem
