#include <dem/breakage/patch_factors.h>

#include <algorithm>
#include <utility>

namespace dem
{
namespace
{
/// The patch of a direction of the body frame.
std::size_t patch_at(const Triple<double> &on_body)
{
  const DirectionGrid::Position position =
      PatchFactors::patches.locate({on_body.x, on_body.y, on_body.z});
  const int ring = position.ring + (position.down >= 0.5);
  const int column = position.column + (position.right >= 0.5);
  return static_cast<std::size_t>(
      std::clamp(ring, 0, PatchFactors::patches.n_polar - 1) *
          PatchFactors::patches.n_azimuth +
      column % PatchFactors::patches.n_azimuth);
}
} // namespace

void PatchFactors::exchange_side(std::int64_t particle,
                                 const Triple<double> &on_body, bool begins,
                                 double &factor)
{
  constexpr auto n_patches = static_cast<std::size_t>(patches.size());
  const auto row = static_cast<std::size_t>(particle);
  if (factors.size() < (row + 1) * n_patches)
    factors.resize((row + 1) * n_patches, 0.);
  double &left = factors[row * n_patches + patch_at(on_body)];
  if (begins)
    factor += std::exchange(left, 0.);
  else
    left += std::exchange(factor, 0.);
}

void PatchFactors::exchange(const ParticleSystem &particles,
                            ContactBatch &batch)
{
  constexpr unsigned mark = 4;
  for (std::size_t k = 0; k < batch.size(); ++k)
  {
    if (!(batch.event[k] & mark))
      continue;
    batch.event[k] = static_cast<std::uint8_t>(batch.event[k] & ~mark);
    const bool begins = batch.is_touching(k);
    const auto id_of = [&particles](std::int32_t particle)
    { return particles.id[static_cast<std::size_t>(particle)]; };
    exchange_side(id_of(batch.a[k]), batch.side_a.direction[k], begins,
                  batch.factor_a[k]);
    if (batch.layout.has_partners)
      exchange_side(id_of(batch.b[k]), batch.side_b.direction[k], begins,
                    batch.factor_b[k]);
  }
}
} // namespace dem
