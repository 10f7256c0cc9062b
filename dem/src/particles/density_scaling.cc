#include <dem/particles/density_scaling.h>

#include <algorithm>

namespace dem
{
DensityScaling density_scaling_of(const ParticleSystem &particles)
{
  DensityScaling found;
  double solid = 0., moved = 0.;
  for (std::size_t i = 0; i < particles.size(); ++i)
  {
    found.n_scaled += particles.mass_factor[i] > 1.;
    found.largest_factor =
        std::max(found.largest_factor, particles.mass_factor[i]);
    solid += particles.solid_mass(i);
    moved += particles.mass(i);
  }
  found.added_mass = solid > 0. ? (moved - solid) / solid : 0.;
  return found;
}
} // namespace dem
