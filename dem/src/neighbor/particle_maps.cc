#include <dem/neighbor/particle_maps.h>

namespace dem
{
void ParticleMaps::update(const ParticleSystem &particles)
{
  map_of.resize(particles.size());
  for (std::size_t i = 0; i < particles.size(); ++i)
  {
    const auto &series = particles.shape[i].series;
    if (map_of[i] && map_of[i]->source() == series)
      continue;
    Map &map = known[series.get()];
    if (!map)
      map = std::make_shared<const RadiusMap>(series);
    map_of[i] = map;
  }
  // Shapes that no particle has any more: their last owner broke.
  std::erase_if(known, [](const auto &entry)
                { return entry.second.use_count() == 1; });
}
} // namespace dem
