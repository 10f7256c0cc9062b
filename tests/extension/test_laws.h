#pragma once

#include <dem/contact/laws/shear_and_rolling.h>

#include <algorithm>

/// Springs as those of dem::Linear, with the values in another order: k_s / k_n
/// [-] and k_n [N/m].
struct Reordered
{
  static constexpr const char *name = "reordered";
  static constexpr double exponent = 1.;
  static constexpr bool scales_with_curvature = false;
  static constexpr bool attracts = false;
  using Tangential = dem::ShearAndRolling;

  static std::vector<dem::LawParameter> parameters()
  {
    return {{"reordered_ratio", "-", 0.8, 0., 1., "k_s / k_n."},
            {"reordered_stiffness", "N/m", 1e6, 1., 1e12, "k_n."}};
  }

  template <class Real>
  DEM_SIMD_INLINE static dem::NormalSpring<Real>
  spring(const dem::LawValues &values, const dem::Prefactors<Real> &,
         const Real &overlap)
  {
    using dem::select;
    const auto is_touching = overlap > 0.;
    dem::NormalSpring<Real> spring;
    spring.stiffness = select(is_touching, Real(values[1]), Real(0.));
    spring.force = values[1] * overlap;
    spring.energy = 0.5 * spring.force * overlap;
    spring.shear_stiffness = values[0] * spring.stiffness;
    spring.first_share = Real(1.);
    return spring;
  }

  template <class Real>
  DEM_SIMD_INLINE static Real energy(const dem::LawValues &, const Real &force,
                                     const Real &overlap)
  {
    return 0.5 * force * overlap;
  }
};

/// A spring that pulls as well: with A where it touches, and with less in a
/// gap, in proportion to what is left of the range h. Values: k_n [N/m], A [N]
/// and h [m]; k_s = k_n.
struct Pulling
{
  static constexpr const char *name = "pulling";
  static constexpr double exponent = 1.;
  static constexpr bool scales_with_curvature = false;
  static constexpr bool attracts = true;
  using Tangential = dem::ShearAndRolling;

  static std::vector<dem::LawParameter> parameters()
  {
    return {{"pulling_stiffness", "N/m", 1e6, 1., 1e12, "k_n and k_s."},
            {"pulling_force", "N", 0.1, 0., 1e6, "A."},
            {"pulling_range", "m", 1e-5, 1e-9, 1e-2, "h."}};
  }

  static double range(const dem::LawValues &values) { return values[2]; }

  template <class Real>
  DEM_SIMD_INLINE static dem::NormalSpring<Real>
  spring(const dem::LawValues &values, const dem::Prefactors<Real> &,
         const Real &overlap)
  {
    using dem::select;
    using std::max;
    using std::min;
    const auto is_touching = overlap > 0.;
    const Real depth = max(overlap, Real(0.));
    const Real share =
        max(Real(0.), Real(1. + min(overlap, Real(0.)) * (1. / values[2])));
    dem::NormalSpring<Real> spring;
    spring.attraction = values[1] * share;
    spring.stiffness = select(is_touching, Real(values[0]), Real(0.));
    spring.shear_stiffness = spring.stiffness;
    spring.force = values[0] * depth - spring.attraction;
    spring.energy = 0.5 * values[0] * depth * depth -
                    values[1] * (depth + 0.5 * values[2] * share * share);
    return spring;
  }

  template <class Real>
  DEM_SIMD_INLINE static Real energy(const dem::LawValues &, const Real &force,
                                     const Real &overlap)
  {
    return 0.5 * force * overlap;
  }
};
