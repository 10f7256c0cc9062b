#pragma once

#include <dem/neighbor/contact_points.h>
#include <dem/particles/particle_system.h>

#include <map>
#include <memory>
#include <vector>

namespace dem
{
/// The radius map of every particle; particles of one shape share one.
class ParticleMaps
{
public:
  /// Makes the maps of shapes that are new.
  void update(const ParticleSystem &particles);

  MappedParticle particle(const ParticleSystem &particles, std::size_t i) const
  {
    return {particles.shape[i], *map_of[i]};
  }

private:
  using Map = std::shared_ptr<const RadiusMap>;

  std::vector<Map> map_of;
  std::map<const Coefficients *, Map> known; ///< by series
};
} // namespace dem
