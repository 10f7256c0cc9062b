#pragma once

#include <Eigen/Dense>

namespace fem
{
/// xx, yy, zz, yz, zx, xy; tension positive. Strains hold twice the shear.
using Voigt = Eigen::Matrix<double, 6, 1>;
using VoigtMatrix = Eigen::Matrix<double, 6, 6>;

/// Strength of a soil; angles of Mohr and Coulomb.
struct SoilStrength
{
  double cohesion = 0.;        ///< c [Pa]
  double friction_angle = 0.;  ///< phi [rad]
  double dilatancy_angle = 0.; ///< psi, of the plastic flow [rad]
};

/// Elastic, perfectly plastic (Drucker and Prager 1952): sqrt(J2) + eta p <= k
/// with p the mean stress, tension positive. Flow along the gradient of
/// sqrt(J2) + eta_bar p; at the apex p = k / eta whatever brings it there.
struct DruckerPrager
{
  double bulk_modulus = 0.;  ///< K [Pa]
  double shear_modulus = 0.; ///< G [Pa]
  double friction = 0.;      ///< eta [-]
  double dilatancy = 0.;     ///< eta_bar [-]
  double strength = 0.;      ///< k [Pa]
};

/// The cone through the compression edges of Mohr and Coulomb, so that a
/// triaxial test gives c and phi back: eta = 6 sin phi / (sqrt 3 (3 - sin
/// phi)), k = 6 c cos phi / (sqrt 3 (3 - sin phi)), eta_bar as eta with psi.
DruckerPrager drucker_prager(double youngs_modulus, double poisson_ratio,
                             const SoilStrength &strength);

/// Hooke's law [Pa].
VoigtMatrix elasticity(double bulk_modulus, double shear_modulus);
/// Its inverse on a stress [-].
Voigt elastic_strain(const DruckerPrager &law, const Voigt &stress);

/// Where a returned stress lies with respect to the yield surface.
enum class YieldRegion
{
  inside,
  cone,
  apex
};

/// Stress after a step that would have led to a trial stress elastically.
struct ReturnedStress
{
  Voigt stress = Voigt::Zero(); ///< [Pa]
  YieldRegion region = YieldRegion::inside;
  double multiplier = 0.; ///< of the flow, on the cone [-]
};

/// Implicit Euler, in closed form (de Souza Neto, Peric and Owen 2008, 8.3).
ReturnedStress return_stress(const DruckerPrager &law, const Voigt &trial);

/// d stress / d strain of return_stress [Pa]; zero at the apex. Symmetric if
/// eta_bar = eta.
VoigtMatrix consistent_tangent(const DruckerPrager &law, const Voigt &trial,
                               const ReturnedStress &result);
} // namespace fem
