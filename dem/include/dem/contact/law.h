#pragma once

#include <dem/contact/spring.h>
#include <dem/parameters/material.h>

#include <concepts>
#include <string_view>
#include <vector>

/// What a contact law is to the loops over contacts. How to add one:
/// docs/developer/extending.md.
namespace dem
{
/// A parameter of a law: a key of its section of the case.
struct LawParameter
{
  std::string_view key, unit;
  double value = 0.;                ///< default
  double lowest = 0., highest = 0.; ///< both are allowed
  std::string_view sentence;
};

/// What a tangential law reads of one step of a contact.
template <class Real>
struct TangentialStep
{
  const ContactMotion<Real> &motion;
  const NormalSpring<Real> &spring;
  const ContactCoefficients &coefficients;
  double time_step;                 ///< [s]
  Real opening_rate;                ///< along the normal [m/s]
  Triple<Real> moved, moved_before; ///< displacement in this step [m]
  Real pressing;                    ///< F_n of the limits [N]
};

/// Force on A across the normal: of the spring and of the dashpot [N].
template <class Real>
struct TangentialForce
{
  Triple<Real> spring, dashpot;
};

/// Advances the springs across the normal in `history` and adds what they lose.
template <class Law, class Real>
concept TangentialLaw = requires(const TangentialStep<Real> &step,
                                 ContactHistory<Real> &history,
                                 Losses<Real> &lost)
{
  {
    Law::advance(step, history, lost)
    } -> std::same_as<TangentialForce<Real>>;
};

/// A normal law with the tangential law that belongs to it.
/// - `exponent` e of F ~ delta^e;
/// - `scales_with_curvature`: prefactors are those of the elliptic contact of
///   both surfaces, else the law has constants of its own and Prefactors are
///   not read;
/// - `attracts`: contacts pull up to the gap range(values); spring() then takes
///   gaps as overlaps < 0.
/// - parameters(): at most max_law_parameters; `values` has them in this order.
template <class Law, class Real>
concept NormalLaw = TangentialLaw<typename Law::Tangential, Real> &&
    requires(const LawValues &values, const Prefactors<Real> &of,
             const Real &number)
{
  {
    Law::name
    } -> std::convertible_to<std::string_view>;
  {
    Law::exponent
    } -> std::convertible_to<double>;
  {
    Law::scales_with_curvature
    } -> std::convertible_to<bool>;
  {
    Law::attracts
    } -> std::convertible_to<bool>;
  {
    Law::parameters()
    } -> std::same_as<std::vector<LawParameter>>;
  {
    Law::spring(values, of, number)
    } -> std::same_as<NormalSpring<Real>>;
  {
    Law::energy(values, number, number)
    } -> std::same_as<Real>;
};

/// Gap up to which contacts of a law pull [m].
template <class Law>
double attraction_range(const LawValues &values)
{
  if constexpr (Law::attracts)
    return Law::range(values);
  else
    return 0.;
}

/// One step of a contact (docs/theory/contact.md): normal force of the law with
/// dashpot c = 2 beta_n sqrt(m* k_n), which never pulls; tangential law of the
/// law. F_n of its limits is elastic or total, see `limit_damping`, without the
/// attraction. Work is taken as the integrator does it: half with the old
/// force, half with the new one. Returns the force on A; the rolling moment on
/// A is history.rolling.
template <class Law, class Real>
requires NormalLaw<Law, Real> DEM_SIMD_INLINE Triple<Real>
advance_contact(const ContactMotion<Real> &motion,
                const NormalSpring<Real> &spring,
                const ContactCoefficients &pair, double time_step,
                ContactHistory<Real> &history, Losses<Real> &lost)
{
  using std::max;
  using std::min;
  using std::sqrt;
  const Triple<Real> &n = motion.normal;
  const Real opening_rate = dot(motion.velocity, n);
  const Triple<Real> moved = Real(time_step) * motion.velocity;
  const Triple<Real> moved_before = Real(time_step) * motion.velocity_before;
  Real bearing = spring.force;
  if constexpr (Law::attracts)
    bearing = bearing + spring.attraction;
  const Real normal_dashpot =
      max(min(Real(0.), Real(-bearing)),
          Real(-2. * pair.normal_damping *
               sqrt(motion.reduced_mass * spring.stiffness) * opening_rate));
  const Real pressing = bearing + pair.limit_damping * normal_dashpot;
  const TangentialForce<Real> across = Law::Tangential::advance(
      TangentialStep<Real>{motion, spring, pair, time_step, opening_rate, moved,
                           moved_before, pressing},
      history, lost);
  const Triple<Real> dashpot = across.dashpot - normal_dashpot * n;

  const Real elastic_work =
      -0.5 * (history.normal_force * dot(moved_before, motion.normal_before) +
              spring.force * dot(moved, n));
  lost.damping +=
      0.5 * (dot(history.dashpot, moved_before) + dot(dashpot, moved));
  lost.non_conservative_work +=
      elastic_work - (spring.energy - history.normal_energy);

  history.dashpot = dashpot;
  history.normal_force = spring.force;
  history.normal_energy = spring.energy;
  if constexpr (Law::attracts)
    history.attraction = spring.attraction;
  return across.spring + dashpot - spring.force * n;
}
} // namespace dem
