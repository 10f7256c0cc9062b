#include <fem/drucker_prager.h>

#include <cmath>

namespace fem
{
namespace
{
const Voigt unit = (Voigt() << 1., 1., 1., 0., 0., 0.).finished();

double mean_of(const Voigt &stress)
{
  return stress.head<3>().sum() / 3.;
}

/// sqrt(J2)
double shear_of(const Voigt &deviator)
{
  return std::sqrt(0.5 * deviator.head<3>().squaredNorm() +
                   deviator.tail<3>().squaredNorm());
}

/// What lies on the cone to round-off does not flow: ground that has just
/// flown stays at rest [-].
constexpr double round_off = 1e-12;

double cone_slope(double angle)
{
  return 6. * std::sin(angle) / (std::sqrt(3.) * (3. - std::sin(angle)));
}
} // namespace

DruckerPrager drucker_prager(double youngs_modulus, double poisson_ratio,
                             const SoilStrength &strength)
{
  const double phi = strength.friction_angle;
  DruckerPrager law;
  law.bulk_modulus = youngs_modulus / (3. * (1. - 2. * poisson_ratio));
  law.shear_modulus = youngs_modulus / (2. * (1. + poisson_ratio));
  law.friction = cone_slope(phi);
  law.dilatancy = cone_slope(strength.dilatancy_angle);
  law.strength = 6. * strength.cohesion * std::cos(phi) /
                 (std::sqrt(3.) * (3. - std::sin(phi)));
  return law;
}

VoigtMatrix elasticity(double bulk_modulus, double shear_modulus)
{
  VoigtMatrix c = VoigtMatrix::Zero();
  c.topLeftCorner<3, 3>().setConstant(bulk_modulus - 2. / 3. * shear_modulus);
  c.diagonal().head<3>().array() += 2. * shear_modulus;
  c.diagonal().tail<3>().setConstant(shear_modulus);
  return c;
}

Voigt elastic_strain(const DruckerPrager &law, const Voigt &stress)
{
  const double mean = mean_of(stress);
  Voigt strain = (stress - mean * unit) / (2. * law.shear_modulus);
  strain.tail<3>() *= 2.;
  return strain + mean / (3. * law.bulk_modulus) * unit;
}

ReturnedStress return_stress(const DruckerPrager &law, const Voigt &trial)
{
  const double mean = mean_of(trial);
  const Voigt deviator = trial - mean * unit;
  const double shear = shear_of(deviator);
  const double excess = shear + law.friction * mean - law.strength;
  if (excess <=
      round_off * (shear + law.friction * std::abs(mean) + law.strength))
    return {trial, YieldRegion::inside, 0.};
  const double multiplier =
      excess /
      (law.shear_modulus + law.bulk_modulus * law.friction * law.dilatancy);
  if (const double left = shear - law.shear_modulus * multiplier; left >= 0.)
    return {left / shear * deviator +
                (mean - law.bulk_modulus * law.dilatancy * multiplier) * unit,
            YieldRegion::cone, multiplier};
  return {law.strength / law.friction * unit, YieldRegion::apex, 0.};
}

VoigtMatrix consistent_tangent(const DruckerPrager &law, const Voigt &trial,
                               const ReturnedStress &result)
{
  const double k = law.bulk_modulus, g = law.shear_modulus;
  if (result.region == YieldRegion::inside)
    return elasticity(k, g);
  if (result.region == YieldRegion::apex)
    return VoigtMatrix::Zero();
  const Voigt deviator = trial - mean_of(trial) * unit;
  const double shear = shear_of(deviator);
  const Voigt along = deviator / shear;
  const double share = g * result.multiplier / shear;
  const double a = 1. / (g + k * law.friction * law.dilatancy);
  return (1. - share) * elasticity(0., g) +
         (share - g * a) * g * along * along.transpose() -
         g * a * k *
             (law.friction * along * unit.transpose() +
              law.dilatancy * unit * along.transpose()) +
         k * (1. - k * law.friction * law.dilatancy * a) * unit *
             unit.transpose();
}
} // namespace fem
