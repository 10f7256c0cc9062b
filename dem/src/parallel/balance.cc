#include "balance.h"

#include <array>
#include <cmath>
#include <numeric>

namespace dem
{
std::vector<float> weights(const DistributedParts &parts)
{
  constexpr float of_motion = 0.15f, of_contact = 0.4f, of_open = 0.05f;
  std::vector<float> weight(parts.particles.size(), of_motion);
  const auto add = [&weight](const ContactBatch &batch, double cost)
  {
    const auto touching = static_cast<float>(cost * of_contact);
    for (std::size_t k = 0; k < batch.size(); ++k)
      weight[static_cast<std::size_t>(batch.a[k])] +=
          batch.is_touching(k) ? touching : of_open;
  };
  add(parts.pairs, 1.);
  for (const auto &boundary : parts.boundaries)
    add(boundary->batch, boundary->contact_cost());
  return weight;
}

double imbalance(const Ranks &ranks, const std::vector<float> &weight)
{
  const double own = std::accumulate(weight.begin(), weight.end(), 0.);
  // In thousandths: the same on every rank.
  std::array sum{std::int64_t(std::llround(1e3 * own))};
  std::array largest{static_cast<double>(sum[0])};
  ranks.sum(sum);
  ranks.max(largest);
  return sum[0] > 0 ? largest[0] * ranks.size() / static_cast<double>(sum[0])
                    : 1.;
}
} // namespace dem
