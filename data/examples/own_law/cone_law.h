#pragma once

#include <dem/contact/laws/shear_and_rolling.h>

/// An elastic cone on a flat: F = C delta^2 (Sneddon 1965), E = C delta^3 / 3,
/// with a shear stiffness in proportion to the normal one. Values: C [N/m^2]
/// and the ratio k_s / k_n [-].
struct Cone
{
  static constexpr const char *name = "cone";
  static constexpr double exponent = 2.;
  static constexpr bool scales_with_curvature = false;
  static constexpr bool attracts = false;
  using Tangential = dem::ShearAndRolling;

  static std::vector<dem::LawParameter> parameters()
  {
    return {
        {"cone_stiffness", "N/m^2", 1e10, 1., 1e15, "C of the law cone."},
        {"stiffness_ratio", "-", 0.8, 0., 1., "k_s / k_n of the law cone."}};
  }

  template <class Real>
  DEM_SIMD_INLINE static dem::NormalSpring<Real>
  spring(const dem::LawValues &values, const dem::Prefactors<Real> &,
         const Real &overlap)
  {
    dem::NormalSpring<Real> spring;
    spring.stiffness = 2. * values[0] * overlap;
    spring.force = values[0] * overlap * overlap;
    spring.energy = (1. / 3.) * spring.force * overlap;
    spring.shear_stiffness = values[1] * spring.stiffness;
    return spring;
  }

  template <class Real>
  DEM_SIMD_INLINE static Real energy(const dem::LawValues &, const Real &force,
                                     const Real &overlap)
  {
    return (1. / 3.) * force * overlap;
  }
};

/// Adds the law to those that a scene may name.
void add_cone_law();
