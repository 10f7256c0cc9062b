#pragma once

#include <dem/triple.h>

#include <algorithm>
#include <cmath>

/// What contact laws are made of, over numbers or SIMD lanes (`Real`): no
/// branch decides the result of a lane, an open contact is one whose springs
/// are zero.
namespace dem
{
/// Coefficients of one kind of contact, mixed once at setup.
struct ContactCoefficients
{
  double friction = 0.;         ///< f [-]
  double rolling_friction = 0.; ///< f_r [-]
  double normal_damping = 0.;   ///< beta_n [-]
  double shear_damping = 0.;    ///< beta_s [-]
  /// Part of the normal dashpot in the force that limits friction: 0 the
  /// elastic force alone, 1 the total one [-]
  double limit_damping = 0.;
};

/// How two surfaces stand and move against each other. Normal from A to B.
template <class Real>
struct ContactMotion
{
  Triple<Real> normal;   ///< direction of the normal force [-]
  Triple<Real> velocity; ///< of B against A at the contact [m/s]
  /// The same and the normal where the contact was in the last step, when its
  /// forces were found: a facet contact may jump.
  Triple<Real> velocity_before, normal_before;
  Triple<Real> spin;            ///< of B against A [rad/s]
  Real reduced_mass = Real(0.); ///< m* [kg]
  /// R: 1/R = 1/r_A + 1/r_B, r from a centre to the contact point, in every
  /// geometry; a wall has none, R = r_A [m]
  Real rolling_radius = Real(0.);
};

/// Factors of the springs of one contact.
template <class Real>
struct Prefactors
{
  Real normal; ///< C of F = C delta^exponent [N/m^exponent]
  Real shear;  ///< C_s of k_s = C_s delta^(exponent - 1) [N/m^exponent]
  /// R of the undeformed surfaces, 1 / (2 sqrt(A B)) with the gap A x^2 + B
  /// y^2; 0 where the law does not use it [m]
  Real radius = Real(0.);
};

/// Stiffness, force and energy of the normal spring at one overlap.
template <class Real>
struct NormalSpring
{
  /// Elastic; < 0 where the law attracts, or to take back what it was [N]
  Real force = Real(0.);
  Real stiffness = Real(0.);       ///< tangent k_n [N/m]
  Real energy = Real(0.);          ///< stored [J]
  Real shear_stiffness = Real(0.); ///< k_s [N/m]
  /// Mean of k_s over the step in which the contact begins, over k_s at its
  /// end. Hertz: that of a trapezoid; a linear spring: part of the step in
  /// which it is there [-]
  Real first_share = Real(0.5);
  /// Of laws that attract: part A >= 0 of the force F = N - A, N presses [N]
  Real attraction = Real(0.);
};

/// A contact of a linear spring that begins or ends between two steps: inside
/// at one end of the step, outside at the other (docs/theory/contact.md).
template <class Real>
struct Crossing
{
  Real inside = Real(0.);    ///< overlap at the one end > 0 [m]
  Real outside = Real(0.);   ///< gap at the other; <= 0: not crossed [m]
  Real stiffness = Real(0.); ///< k_n dt^2 / m* [-]
};

/// Part of the first force of a contact that was not there for the whole step
/// before it, such that an undamped impact loses no energy by it [-].
template <class Real>
DEM_SIMD_INLINE Real part_before_begin(const Crossing<Real> &at)
{
  using std::max;
  using std::sqrt;
  const Real way = max(
      Real(0.), Real(at.inside + at.outside - 0.5 * at.stiffness * at.inside));
  const auto is_crossed = at.outside > 0.;
  const Real sum =
      way + sqrt(max(Real(0.),
                     Real(way * way + at.stiffness * at.inside * at.outside)));
  return select(is_crossed, at.outside / select(is_crossed, sum, Real(1.)),
                Real(0.));
}

/// Part of the last force of a contact that was not there for the whole step
/// after it, by the same rule [-].
template <class Real>
DEM_SIMD_INLINE Real part_after_end(const Crossing<Real> &at)
{
  using std::max;
  using std::sqrt;
  const Real way = at.inside + at.outside;
  const auto is_crossed = at.outside > 0.;
  const Real sum =
      way + sqrt(max(Real(0.),
                     Real(way * way - at.stiffness * at.inside * at.outside)));
  return select(is_crossed, at.outside / select(is_crossed, sum, Real(1.)),
                Real(0.));
}

/// What a contact carries from step to step. Springs act on body A.
template <class Real>
struct ContactHistory
{
  Triple<Real> shear;                 ///< spring force on A [N]
  Triple<Real> rolling;               ///< spring moment on A [N m]
  Triple<Real> dashpot;               ///< force on A, last step [N]
  Real shear_compliance = Real(0.);   ///< 1 / k_s, last step; 0: open [m/N]
  Real rolling_compliance = Real(0.); ///< 1 / k_r [rad/(N m)]
  Real normal_force = Real(0.);       ///< elastic, last step [N]
  Real normal_energy = Real(0.);      ///< elastic, last step [J]
  Real attraction = Real(0.); ///< NormalSpring::attraction, last step [N]
};

/// Energy that left the springs of contacts [J].
template <class Real>
struct Losses
{
  Real friction = Real(0.); ///< sliding, and shear springs let go
  Real rolling = Real(0.);  ///< rolling resistance beyond its limit
  Real damping = Real(0.);  ///< dashpots
  /// Normal springs gained it (if negative) without work: by turning where the
  /// force has no lever against it, by a change of C_H or of the facet
  Real non_conservative_work = Real(0.);

  Losses &operator+=(const Losses &other)
  {
    friction += other.friction;
    rolling += other.rolling;
    damping += other.damping;
    non_conservative_work += other.non_conservative_work;
    return *this;
  }
};

using Dissipation = Losses<double>;

/// Stored energy of the shear spring [J].
template <class Real>
DEM_SIMD_INLINE Real shear_energy(const ContactHistory<Real> &history)
{
  return 0.5 * dot(history.shear, history.shear) * history.shear_compliance;
}

/// Stored energy of the shear and rolling springs [J].
template <class Real>
DEM_SIMD_INLINE Real tangential_energy(const ContactHistory<Real> &history)
{
  return shear_energy(history) + 0.5 * dot(history.rolling, history.rolling) *
                                     history.rolling_compliance;
}

/// Turns a tangential vector into the plane across `normal`, keeping its
/// length.
template <class Real>
DEM_SIMD_INLINE Triple<Real> turn_into_plane(const Triple<Real> &vector,
                                             const Triple<Real> &normal)
{
  using std::sqrt;
  const Real along = dot(vector, normal);
  const Triple<Real> flat = vector - along * normal;
  const Real remaining = dot(flat, flat);
  // A vector along the normal (below 1e-12 of its length) is let go.
  const auto has_rest = remaining > 1e-24 * along * along;
  const Real tilt =
      along * along / select(has_rest, remaining, Real(1.)); // tangent squared
  Real stretch = 1. + 0.5 * tilt;
  // The root only where its series is not exact to the last digit.
  const auto is_tilted = tilt > 1e-8;
  if (any(is_tilted))
    stretch = select(is_tilted, sqrt(1. + tilt), stretch);
  return select(has_rest, stretch, Real(0.)) * flat;
}

/// A spring in the contact plane with a slider.
template <class Real>
struct SpringStep
{
  Triple<Real> value;         ///< after the step
  Real compliance = Real(0.); ///< 1 / stiffness after the step; 0 if open
  Real dissipated = Real(0.); ///< work of the motion less what is stored [J]
};

/// A spring in the contact plane as the last step left it.
template <class Real>
struct Spring
{
  Triple<Real> value;         ///< force or moment on A
  Real compliance = Real(0.); ///< 0: it was not there
  Triple<Real> moved;         ///< displacement over which it has worked since
};

/// Stiffness of a spring at the end of a step.
template <class Real>
struct SpringStiffness
{
  Real value = Real(0.);       ///< 0: the contact is open
  Real first_share = Real(1.); ///< see NormalSpring::first_share [-]
};

/// One increment of an elastic-perfectly-plastic spring: turned into the
/// plane, scaled down when the stiffness falls (so that it makes no energy),
/// moved by the part of `displacement` in the plane, capped at `limit`. A
/// stiffness that rises acts with its mean over the step, one that falls with
/// its value at the end: both are of second order in the step.
template <class Real>
DEM_SIMD_INLINE SpringStep<Real>
advance_spring(const Spring<Real> &old, const Triple<Real> &normal,
               const Triple<Real> &displacement,
               const SpringStiffness<Real> &stiffness, const Real &limit)
{
  using std::min;
  using std::sqrt;
  const Real &k = stiffness.value;
  const auto is_there = k > 0., was_there = old.compliance > 0.;
  const Real compliance_before = select(was_there, old.compliance, Real(1.));
  const Real k_after = select(is_there, k, Real(1.));
  // One division for 1 / k of both ends of the step.
  const Real over_both = 1. / (compliance_before * k_after);
  const Real mean =
      select(was_there, Real(0.5 * (k + min(k, Real(k_after * over_both)))),
             Real(stiffness.first_share * k));
  const Real kept = min(Real(1.), Real(k * old.compliance));
  const Triple<Real> increment =
      displacement - dot(displacement, normal) * normal;
  SpringStep<Real> step;
  step.value = kept * turn_into_plane(old.value, normal) + mean * increment;
  const Real size = dot(step.value, step.value);
  const auto is_sliding = size > limit * limit;
  if (any(is_sliding))
  {
    const Real scale = select(
        is_sliding, limit / sqrt(select(is_sliding, size, Real(1.))), Real(1.));
    step.value = scale * step.value;
  }
  step.compliance =
      select(is_there, Real(compliance_before * over_both), Real(0.));
  step.dissipated =
      0.5 * (dot(old.value, old.moved) + dot(step.value, displacement) +
             dot(old.value, old.value) * old.compliance -
             dot(step.value, step.value) * step.compliance);
  return step;
}

/// Share of `dashpot` that the limit of the slider leaves to it beside the
/// `spring`, largest s <= 1 with |spring + s dashpot| <= limit [-]: 0 while
/// sliding on, and continuous there. |spring| <= limit; both in the plane.
template <class Real>
DEM_SIMD_INLINE Real share_within(const Triple<Real> &spring,
                                  const Triple<Real> &dashpot,
                                  const Real &limit)
{
  using std::max;
  using std::min;
  using std::sqrt;
  const Real outward = dot(spring, dashpot), square = dot(dashpot, dashpot);
  const Real room = max(Real(0.), Real(limit * limit - dot(spring, spring)));
  const auto is_beyond = square + 2. * outward > room;
  if (!any(is_beyond))
    return Real(1.);
  // Root of square s^2 + 2 outward s = room, without loss of digits.
  const Real root = sqrt(outward * outward + square * room);
  const auto is_outward = outward > 0.;
  const Real over = select(is_outward, Real(outward + root), square);
  const Real share = select(is_outward, room, Real(root - outward)) /
                     select(is_beyond && over > 0., over, Real(1.));
  return select(is_beyond, min(Real(1.), share), Real(1.));
}
} // namespace dem
