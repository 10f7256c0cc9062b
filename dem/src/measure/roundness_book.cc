#include <dem/measure/roundness_book.h>
#include <dem/shape/measures.h>

#include <utility>

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
  decltype(known) present; // shapes that no particle has any more are forgotten
  for (const ParticleShape &body : particles.shape)
    if (body.series)
    {
      const double value = of(body);
      present.emplace(body.series, value);
      sum += body.volume * value;
      weight += body.volume;
    }
  known = std::move(present);
  return weight > 0. ? sum / weight : 1.;
}
} // namespace dem
