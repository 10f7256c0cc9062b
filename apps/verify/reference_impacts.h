#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

/// Closed forms of impacts and of rolling, written without any code of the
/// engine: what its kernels are compared with.
namespace spall::verify::reference
{
/// Head-on impact of two elastic spheres: m* x'' = -4/3 E* sqrt(R*) x^(3/2).
struct HertzImpact
{
  double modulus = 0.; ///< E* [Pa]
  double radius = 0.;  ///< R* = R1 R2 / (R1 + R2) [m]
  double mass = 0.;    ///< m* = m1 m2 / (m1 + m2) [kg]
  double speed = 0.;   ///< of approach, > 0 [m/s]

  /// C_H of F = C_H x^(3/2) [N/m^(3/2)].
  double prefactor() const { return 4. / 3. * modulus * std::sqrt(radius); }

  /// Energy: 1/2 m* v^2 = 2/5 C_H x^(5/2) [m].
  double peak_overlap() const
  {
    return std::pow(1.25 * mass * speed * speed / prefactor(), 0.4);
  }

  double peak_force() const ///< [N]
  {
    return prefactor() * std::pow(peak_overlap(), 1.5);
  }

  /// 2 / v int_0^x_max dx / sqrt(1 - (x / x_max)^(5/2))
  /// = 4 sqrt(pi) Gamma(2/5) / (5 Gamma(9/10)) x_max / v [s].
  double duration() const
  {
    return 0.8 * std::sqrt(std::numbers::pi) * std::tgamma(0.4) /
           std::tgamma(0.9) * peak_overlap() / speed;
  }
};

struct SphereMaterial
{
  double density = 0.;         ///< rho [kg/m^3]
  double young_modulus = 0.;   ///< E [Pa]
  double poisson_ratio = 0.;   ///< nu [-]
  double shear_modulus() const ///< G [Pa]
  {
    return young_modulus / (2. * (1. + poisson_ratio));
  }
};

inline double sphere_mass(double density, double radius) ///< [kg]
{
  return 4. / 3. * std::numbers::pi * density * radius * radius * radius;
}

/// Two equal spheres that approach each other at `closing_speed` together.
inline HertzImpact equal_spheres(const SphereMaterial &material, double radius,
                                 double closing_speed)
{
  const double nu = material.poisson_ratio;
  return {.modulus = 0.5 * material.young_modulus / (1. - nu * nu),
          .radius = 0.5 * radius,
          .mass = 0.5 * sphere_mass(material.density, radius),
          .speed = closing_speed};
}

/// A sphere that falls on a rigid plane.
inline HertzImpact sphere_on_rigid_plane(const SphereMaterial &material,
                                         double radius, double speed)
{
  const double nu = material.poisson_ratio;
  return {.modulus = material.young_modulus / (1. - nu * nu),
          .radius = radius,
          .mass = sphere_mass(material.density, radius),
          .speed = speed};
}

/// Rebound speed over impact speed of x'' + 2 zeta x' + x = 0, x(0) = 0, left
/// when the total force passes zero (no tension), zeta >= 0, not 1 [-].
inline double oscillator_restitution(double zeta)
{
  if (zeta > 1.)
  {
    const double slow = std::sqrt(zeta * zeta - 1.);
    return std::exp(-zeta / slow * std::log((zeta + slow) / (zeta - slow)));
  }
  const double damped = std::sqrt(1. - zeta * zeta);
  const double phase = std::atan2(2. * zeta * damped, 2. * zeta * zeta - 1.);
  return std::exp(-zeta / damped * phase);
}

/// Damping ratio of the oscillator that a Hertz impact with the dashpot
/// 2 beta sqrt(m* k_n) becomes in x^(5/4), k_n = dF/dx [-].
inline double hertz_damping_ratio(double beta)
{
  return beta * std::sqrt(6. / 5.);
}

/// Hertz contact, dashpot by the tangent stiffness, no tension [-].
inline double hertz_restitution(double beta)
{
  return oscillator_restitution(hertz_damping_ratio(beta));
}

/// Impulse of the elastic part of the force alone over m v, where the whole
/// force has 1 + e: the dashpot takes 4 zeta^2 e of it until the force is zero,
/// and the elastic part continues for 2 zeta^2 e after that. A friction limit
/// of mu times the elastic force gives the impulse mu times this [-].
inline double hertz_elastic_impulse(double beta)
{
  const double zeta = hertz_damping_ratio(beta);
  return 1. + hertz_restitution(beta) * (1. - 2. * zeta * zeta);
}

/// Linear contact, dashpot 2 beta sqrt(m k), no tension [-].
inline double linear_restitution(double beta)
{
  return oscillator_restitution(beta);
}

/// Undamped oblique impact of a solid sphere on a plane with an elastic shear
/// spring: T' = -k_s u, scaled down with k_s while that falls, |T| <= mu F;
/// u, the speed of the contact point, has u' = 7/2 T / m.
struct ObliqueImpact
{
  HertzImpact normal;
  double shear_ratio = 0.; ///< k_s / k_n [-]
  double friction = 0.;    ///< mu [-]

  /// u when the sphere leaves [m/s]; small steps of first order.
  double contact_speed_after(double contact_speed, int n_steps) const
  {
    const double h = normal.duration() / n_steps, mass = normal.mass;
    double x = 0., v = normal.speed, u = contact_speed, shear = 0., old = 0.;
    do
    {
      x += h * v;
      if (!(x > 0.))
        break;
      const double force = normal.prefactor() * x * std::sqrt(x);
      const double stiffness = shear_ratio * 1.5 * force / x;
      if (stiffness < old)
        shear *= stiffness / old;
      old = stiffness;
      const double limit = friction * force;
      shear = std::clamp(shear - stiffness * u * h, -limit, limit);
      v -= h * force / mass;
      u += h * 3.5 * shear / mass;
    } while (true);
    return u;
  }
};

/// Oblique impact of a solid sphere on a plane while it slides all through:
/// changes of tangential speed and of spin.
struct GrossSliding
{
  double friction = 0.;     ///< mu [-]
  double restitution = 1.;  ///< e [-]
  double normal_speed = 0.; ///< of approach, > 0 [m/s]
  double radius = 0.;       ///< R [m]

  double tangential_loss() const ///< mu (1 + e) v_n [m/s]
  {
    return friction * (1. + restitution) * normal_speed;
  }

  /// 5/2 mu (1 + e) v_n / R [rad/s].
  double spin() const { return 2.5 * tangential_loss() / radius; }

  /// The contact point slides to the end if v_t >= 7/2 mu (1 + e) v_n [m/s].
  double least_tangential_speed() const { return 3.5 * tangential_loss(); }
};

/// A solid sphere that rolls without slip, with rolling resistance mu_r.
struct RollingSphere
{
  double rolling_friction = 0.; ///< mu_r [-]
  double gravity = 9.81;        ///< g [m/s^2]

  /// On a level plane: 5/7 mu_r g [m/s^2].
  double deceleration() const { return 5. / 7. * rolling_friction * gravity; }

  /// Way until rest from v_0: v_0^2 / (2 deceleration) [m].
  double stop_distance(double speed) const
  {
    return 0.5 * speed * speed / deceleration();
  }

  /// Down a plane of this angle: 5/7 g cos (tan - mu_r), 0 at rest [m/s^2].
  double incline_acceleration(double angle) const
  {
    return 5. / 7. * gravity * std::cos(angle) *
           std::max(0., std::tan(angle) - rolling_friction);
  }
};

/// Angular frequencies of the rocking of a sphere on a plane after its stop,
/// k_r = k_s R^2: lambda^2 - 6 lambda + 5/2 = 0, omega^2 = lambda k_s / m.
struct RockingModes
{
  double slow = 0., fast = 0.; ///< [rad/s]
};

inline RockingModes rocking_modes(double shear_stiffness, double mass)
{
  const double unit = shear_stiffness / mass, root = std::sqrt(6.5);
  return {std::sqrt((3. - root) * unit), std::sqrt((3. + root) * unit)};
}
} // namespace spall::verify::reference
