#include <fem/neo_hooke.h>

#include <cmath>

namespace fem
{
using Matrix = Eigen::Matrix3d;

double shape_energy(const NeoHooke &law, const Matrix &deformation)
{
  return 0.5 * law.shear_modulus *
         (std::pow(deformation.determinant(), -2. / 3.) *
              deformation.squaredNorm() -
          3.);
}

Matrix shape_stress(const NeoHooke &law, const Matrix &deformation)
{
  const Matrix inverse = deformation.inverse().transpose();
  return law.shear_modulus * std::pow(deformation.determinant(), -2. / 3.) *
         (deformation - deformation.squaredNorm() / 3. * inverse);
}

Matrix shape_stress_change(const NeoHooke &law, const Matrix &deformation,
                           const Matrix &change)
{
  const Matrix inverse = deformation.inverse().transpose();
  const double squared = deformation.squaredNorm();
  const double volume = (inverse.array() * change.array()).sum();
  const double along = (deformation.array() * change.array()).sum();
  return law.shear_modulus * std::pow(deformation.determinant(), -2. / 3.) *
         (change - 2. / 3. * along * inverse +
          squared / 3. * inverse * change.transpose() * inverse -
          2. / 3. * volume * (deformation - squared / 3. * inverse));
}

double volume_energy(const NeoHooke &law, double ratio)
{
  return 0.5 * law.bulk_modulus *
         (0.5 * (ratio * ratio - 1.) - std::log(ratio));
}

double volume_stress(const NeoHooke &law, double ratio)
{
  return 0.5 * law.bulk_modulus * (ratio - 1. / ratio);
}

double volume_stiffness(const NeoHooke &law, double ratio)
{
  return 0.5 * law.bulk_modulus * (1. + 1. / (ratio * ratio));
}
} // namespace fem
