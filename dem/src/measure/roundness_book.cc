#include <dem/measure/roundness_book.h>
#include <dem/shape/measures.h>

namespace dem
{
double RoundnessBook::of(const ParticleShape &body)
{
  if (!body.series)
    return 1.;
  const auto [entry, is_new] = known.try_emplace(body.series, 1.);
  if (is_new)
    entry->second = roundness(*body.series, standard_quadrature());
  return entry->second;
}

double RoundnessBook::mean(const ParticleSystem &particles)
{
  double sum = 0., weight = 0.;
  for (const ParticleShape &body : particles.shape)
    if (body.series)
    {
      sum += body.volume * of(body);
      weight += body.volume;
    }
  // Shapes that no particle has any more.
  std::erase_if(known,
                [](const auto &entry) { return entry.first.use_count() == 1; });
  return weight > 0. ? sum / weight : 1.;
}
} // namespace dem
