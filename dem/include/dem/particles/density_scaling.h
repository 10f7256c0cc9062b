#pragma once

#include <dem/particles/particle_system.h>

namespace dem
{
/// Density that is accelerated over that of the solid, for a particle of this
/// diameter (twice the equivalent radius):
///
///   f = (D / d)^3 for d < D, 1 for d >= D or D = 0
///
/// with the threshold D of density scaling. The particle then has the mass of
/// one of the same shape with the diameter D. A contact of constant stiffness,
/// normal, shear or rolling, allows m / k alone, so that both have the same
/// stable step. A Hertz contact that carries the same force is softer on the
/// smaller particle (k ~ (R F)^(1/3)): its step is longer. [m, m to -]
inline double density_scaling(double diameter, double threshold)
{
  if (diameter >= threshold)
    return 1.;
  const double ratio = threshold / diameter;
  return ratio * ratio * ratio;
}

/// What density scaling has done to particles.
struct DensityScaling
{
  std::size_t n_scaled = 0;   ///< particles
  double largest_factor = 1.; ///< [-]
  double added_mass = 0.;     ///< over the mass of all solids [-]
};

DensityScaling density_scaling_of(const ParticleSystem &particles);
} // namespace dem
