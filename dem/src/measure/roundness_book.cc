#include <dem/measure/roundness_book.h>
#include <dem/parallel/rank_sums.h>
#include <dem/shape/measures.h>

#include <array>
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

double RoundnessBook::mean(const ParticleSystem &particles, const Ranks &ranks)
{
  std::array<ExactSum, 2> sums; // roundness by volume, and volume
  decltype(known) present; // shapes that no particle has any more are forgotten
  for (std::size_t i = 0; i < particles.n_owned(); ++i)
    if (const ParticleShape &body = particles.shape[i]; body.series)
    {
      const double value = of(body);
      present.emplace(body.series, value);
      sums[0].add(body.volume * value);
      sums[1].add(body.volume);
    }
  known = std::move(present);
  sum_over_ranks(ranks, sums);
  const double weight = sums[1].value();
  return weight > 0. ? sums[0].value() / weight : 1.;
}
} // namespace dem
