#pragma once

#include <dem/contact/elliptic.h>
#include <dem/parameters/engine.h>

#include <cstdint>
#include <vector>

namespace dem
{
/// The elasticity of every pair of materials (Particles::material) and of each
/// on a rigid plate, mixed once at setup.
class ElasticityTable
{
public:
  /// Throws std::invalid_argument if a modulus is not positive.
  explicit ElasticityTable(const EngineParameters &parameters);

  const PairElasticity &pair(std::uint8_t a, std::uint8_t b) const
  {
    return of_pairs[n * a + b];
  }
  const PairElasticity &on_plate(std::uint8_t a) const { return of_plates[a]; }

private:
  std::size_t n = 0; ///< materials
  std::vector<PairElasticity> of_pairs, of_plates;
};
} // namespace dem
