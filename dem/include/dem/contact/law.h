#pragma once

#include <dem/contact/elliptic.h>
#include <dem/contact/material.h>
#include <dem/vector.h>

#include <algorithm>
#include <cmath>

namespace dem
{
/// Coefficients of one kind of contact, mixed once at setup.
struct ContactCoefficients
{
  double friction = 0.;         ///< f [-]
  double rolling_friction = 0.; ///< f_r [-]
  double normal_damping = 0.;   ///< beta_n [-]
  double shear_damping = 0.;    ///< beta_s [-]
};

/// How two surfaces stand and move against each other. Normal from A to B.
struct ContactMotion
{
  double overlap = 0.;          ///< delta > 0 [m]
  Vec3 normal = Vec3::UnitX();  ///< direction of the normal force [-]
  Vec3 velocity = Vec3::Zero(); ///< of B against A at the contact [m/s]
  /// The same where the contact was in the last step: a facet contact may jump.
  Vec3 velocity_before = Vec3::Zero();
  Vec3 spin = Vec3::Zero();   ///< of B against A [rad/s]
  double reduced_mass = 0.;   ///< m* [kg]
  double rolling_radius = 0.; ///< R: 1/R = 1/r_A + 1/r_B [m]
};

/// Stiffness, force and energy of the normal spring at one overlap.
struct NormalSpring
{
  double force = 0.;           ///< elastic [N]
  double stiffness = 0.;       ///< tangent k_n [N/m]
  double energy = 0.;          ///< stored [J]
  double shear_stiffness = 0.; ///< k_s [N/m]
};

/// F = C_H delta^(3/2), k_n = 3/2 C_H delta^(1/2), E = 2/5 F delta (MODEL 5.1).
inline NormalSpring hertz_spring(const HertzPrefactors &prefactors,
                                 double overlap)
{
  const double root = std::sqrt(overlap);
  NormalSpring spring;
  spring.stiffness = 1.5 * prefactors.normal * root;
  spring.force = prefactors.normal * overlap * root;
  spring.energy = 0.4 * spring.force * overlap;
  spring.shear_stiffness = prefactors.tangential * root;
  return spring;
}

/// F = k_n delta, E = k_n delta^2 / 2 (walls).
inline NormalSpring linear_spring(const WallMaterial &wall, double overlap)
{
  return {wall.normal_stiffness * overlap, wall.normal_stiffness,
          0.5 * wall.normal_stiffness * overlap * overlap,
          wall.shear_stiffness};
}

/// What a contact carries from step to step. Springs act on body A.
struct ContactHistory
{
  Vec3 normal = Vec3::UnitX();         ///< of the last step [-]
  Vec3 shear = Vec3::Zero();           ///< spring force on A [N]
  Vec3 rolling = Vec3::Zero();         ///< spring moment on A [N m]
  Vec3 shear_dashpot = Vec3::Zero();   ///< force on A [N]
  double shear_stiffness = 0.;         ///< k_s of the last step [N/m]
  double rolling_stiffness = 0.;       ///< k_r of the last step [N m/rad]
  double normal_force = 0.;            ///< elastic, last step [N]
  double normal_dashpot = 0.;          ///< last step, positive: compressive [N]
  double normal_energy = 0.;           ///< elastic, last step [J]
  double overlap = 0.;                 ///< last step, 0: open [m]
  double factor_a = 0., factor_b = 0.; ///< cumulative factors of both sides [-]
};

/// Energy that left the springs of a contact since it was last emptied [J].
struct Dissipation
{
  double friction = 0.; ///< sliding, and shear springs let go
  double rolling = 0.;  ///< rolling resistance beyond its limit
  double damping = 0.;  ///< dashpots
  /// Normal springs gained it (if negative) without work: by turning where the
  /// force has no lever against it, by a change of C_H or of the facet
  double shape_work = 0.;

  Dissipation &operator+=(const Dissipation &other)
  {
    friction += other.friction;
    rolling += other.rolling;
    damping += other.damping;
    shape_work += other.shape_work;
    return *this;
  }
};

/// Force and moment of one contact on A (on B: the opposite, at B's lever).
struct ContactForce
{
  Vec3 force = Vec3::Zero();  ///< on A [N]
  Vec3 moment = Vec3::Zero(); ///< rolling moment on A [N m]
};

/// Stored energy of the shear and rolling springs [J].
inline double tangential_energy(const ContactHistory &history)
{
  double energy = 0.;
  if (history.shear_stiffness > 0.)
    energy += 0.5 * history.shear.squaredNorm() / history.shear_stiffness;
  if (history.rolling_stiffness > 0.)
    energy += 0.5 * history.rolling.squaredNorm() / history.rolling_stiffness;
  return energy;
}

/// Turns a tangential vector into the plane across `normal`, keeping its
/// length.
inline Vec3 turn_into_plane(const Vec3 &vector, const Vec3 &normal)
{
  const double length = vector.norm();
  const Vec3 projected = vector - vector.dot(normal) * normal;
  const double remaining = projected.norm();
  return remaining > 1e-12 * length ? Vec3(projected * (length / remaining))
                                    : Vec3::Zero();
}

/// A spring in the contact plane with a slider.
struct SpringStep
{
  Vec3 value = Vec3::Zero(); ///< after the step
  bool is_sliding = false;
  double dissipated = 0.; ///< work of the motion less what is stored [J]
};

/// A spring in the contact plane as the last step left it.
struct Spring
{
  const Vec3 &value;     ///< force or moment on A
  double stiffness = 0.; ///< 0: it was not there
  const Vec3 &moved;     ///< displacement over which it has worked since
};

/// One increment of an elastic-perfectly-plastic spring: turned into the
/// plane, scaled down when the stiffness falls (so that it makes no energy),
/// moved by the part of `displacement` in the plane, capped at `limit`.
inline SpringStep advance_spring(const Spring &old, const Vec3 &normal,
                                 const Vec3 &displacement, double stiffness,
                                 double limit)
{
  Vec3 start = turn_into_plane(old.value, normal);
  double before = 0.;
  if (old.stiffness > 0.)
  {
    before = 0.5 * old.value.squaredNorm() / old.stiffness;
    if (stiffness < old.stiffness)
      start *= stiffness / old.stiffness;
  }
  const Vec3 increment = displacement - displacement.dot(normal) * normal;
  SpringStep step;
  step.value = start + stiffness * increment;
  const double size = step.value.norm();
  step.is_sliding = size > limit;
  if (step.is_sliding)
    step.value *= limit / size;
  const double after =
      stiffness > 0. ? 0.5 * step.value.squaredNorm() / stiffness : 0.;
  step.dissipated =
      0.5 * (old.value.dot(old.moved) + step.value.dot(displacement)) + before -
      after;
  return step;
}

/// One step of the rolling-resistant incremental law (MODEL 5.4) for a
/// touching contact: total normal force without tension, Mindlin shear spring
/// with Coulomb slider, rolling spring k_r = k_s R^2 with limit f_r R F_n,
/// dashpots c = 2 beta sqrt(m* k) with the tangent stiffness; the shear
/// dashpot rests while sliding. Work is taken as the integrator does it: half
/// with the old force, half with the new one.
inline ContactForce advance_contact(const ContactMotion &motion,
                                    const NormalSpring &spring,
                                    const ContactCoefficients &pair,
                                    double time_step, ContactHistory &history,
                                    Dissipation &lost)
{
  const Vec3 &n = motion.normal;
  const double opening_rate = motion.velocity.dot(n);
  const Vec3 displacement = motion.velocity * time_step,
             moved_before = motion.velocity_before * time_step;
  const double closing = -displacement.dot(n),
               closing_before = -moved_before.dot(history.normal);
  const double normal_dashpot = std::max(
      -spring.force, -2. * pair.normal_damping *
                         std::sqrt(motion.reduced_mass * spring.stiffness) *
                         opening_rate);
  lost.damping += 0.5 * (history.normal_dashpot * closing_before +
                         normal_dashpot * closing);

  const Vec3 sliding_velocity = motion.velocity - opening_rate * n;
  const SpringStep shear = advance_spring(
      {history.shear, history.shear_stiffness, moved_before}, n, displacement,
      spring.shear_stiffness, pair.friction * spring.force);
  lost.friction += shear.dissipated;
  const Vec3 shear_dashpot =
      shear.is_sliding
          ? Vec3::Zero()
          : Vec3(2. * pair.shear_damping *
                 std::sqrt(motion.reduced_mass * spring.shear_stiffness) *
                 sliding_velocity);
  lost.damping +=
      0.5 * (history.shear_dashpot + shear_dashpot).dot(displacement);

  const double rolling_stiffness = pair.rolling_friction > 0.
                                       ? spring.shear_stiffness *
                                             motion.rolling_radius *
                                             motion.rolling_radius
                                       : 0.;
  if (rolling_stiffness > 0.)
  {
    const Vec3 turn = motion.spin * time_step;
    const SpringStep rolling = advance_spring(
        {history.rolling, history.rolling_stiffness, turn}, n, turn,
        rolling_stiffness,
        pair.rolling_friction * motion.rolling_radius * spring.force);
    lost.rolling += rolling.dissipated;
    history.rolling = rolling.value;
  }
  lost.shape_work +=
      0.5 * (history.normal_force * closing_before + spring.force * closing) -
      (spring.energy - history.normal_energy);

  history.normal = n;
  history.shear = shear.value;
  history.shear_dashpot = shear_dashpot;
  history.shear_stiffness = spring.shear_stiffness;
  history.rolling_stiffness = rolling_stiffness;
  history.normal_force = spring.force;
  history.normal_dashpot = normal_dashpot;
  history.normal_energy = spring.energy;
  history.overlap = motion.overlap;

  ContactForce out;
  out.force =
      -(spring.force + normal_dashpot) * n + shear.value + shear_dashpot;
  out.moment = history.rolling;
  return out;
}

/// Ends a touching contact: what its springs still hold is lost, less the work
/// that the last forces have done over `displacement`, of B against A in the
/// last step [m].
inline void open_contact(ContactHistory &history, const Vec3 &displacement,
                         Dissipation &lost)
{
  if (history.overlap <= 0.)
    return;
  const double closing = -0.5 * displacement.dot(history.normal);
  double shear = 0.;
  if (history.shear_stiffness > 0.)
    shear = 0.5 * history.shear.squaredNorm() / history.shear_stiffness;
  lost.rolling += tangential_energy(history) - shear;
  lost.friction += shear + 0.5 * history.shear.dot(displacement);
  lost.damping += history.normal_dashpot * closing +
                  0.5 * history.shear_dashpot.dot(displacement);
  lost.shape_work += history.normal_energy + history.normal_force * closing;
  history = ContactHistory{};
}
} // namespace dem
