#pragma once

#include <dem/engine.h>

/// Impacts of one ball on a rigid plane and on another ball, in the engine.
namespace spall::verify
{
struct BallMaterial
{
  double density = 0.;       ///< rho [kg/m^3]
  double shear_modulus = 0.; ///< G [Pa]
  double poisson_ratio = 0.; ///< nu [-]
  double friction = 0.;      ///< mu [-]
  double restitution = 1.;   ///< e of the normal impact [-]
  /// Of friction, with the force of the dashpot or without.
  dem::FrictionLimit friction_limit = dem::FrictionLimit::elastic;
};

/// Density, Young's modulus [Pa] and Poisson's ratio; no friction, e = 1.
BallMaterial elastic_ball(double density, double young_modulus,
                          double poisson_ratio);

/// beta of the law whose restitution is e (no tension), 0 < e <= 1 [-].
double damping_of(double restitution);

/// A ball with its motion when it touches; the other body is along +x.
struct Missile
{
  BallMaterial material;
  double radius = 0.;                     ///< [m]
  dem::Vec3 velocity = dem::Vec3::Zero(); ///< [m/s]
  dem::Vec3 spin = dem::Vec3::Zero();     ///< [rad/s]
};

struct Rebound
{
  dem::Vec3 velocity = dem::Vec3::Zero(); ///< [m/s]
  dem::Vec3 spin = dem::Vec3::Zero();     ///< [rad/s]
  double peak_overlap = 0.;               ///< [m]
  double peak_force = 0.;                 ///< [N]
  double duration = 0.;                   ///< until the balls part [s]
  double damped = 0.;                     ///< energy lost in dashpots [J]
  dem::Vec3 momentum = dem::Vec3::Zero(); ///< of both bodies [kg m/s]
};

/// Against a rigid Hertz plane: a ball of 10^4 times the radius, 10^12 times
/// the mass and so little elasticity that the pair is that of ball and plane.
/// 1 / R is off by 1e-4, F by 5e-5.
Rebound strike_plane(const Missile &missile, double time_step);

/// Against its image by point reflection: the same ball, turned about y.
Rebound strike_image(const Missile &missile, double time_step);

/// Against a ball at rest of another radius and mass (over that of the same
/// material) that has `stiffening` times the moduli.
struct Target
{
  double radius = 0.;      ///< [m]
  double mass_factor = 1.; ///< [-]
  double stiffening = 1.;  ///< [-]
};
Rebound strike_ball(const Missile &missile, const Target &target,
                    double time_step);
} // namespace spall::verify
