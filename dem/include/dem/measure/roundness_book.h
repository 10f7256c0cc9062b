#pragma once

#include <dem/parallel/ranks.h>
#include <dem/particles/particle_system.h>

#include <map>
#include <memory>

namespace dem
{
/// Roundness R_g of particles (Eq. 30). Stores the shapes that it has
/// evaluated, so that only particles that have broken since cost anything; the
/// numbers are those of a new book, bit for bit.
class RoundnessBook
{
public:
  /// 1 of a sphere [-].
  double of(const ParticleShape &body);

  /// Mean of the particles of all ranks with shapes, weighed by volume; 1
  /// without any [-]. Collective.
  double mean(const ParticleSystem &particles, const Ranks &ranks);

private:
  /// Unbroken particles of one shape have one roundness, whatever their scale.
  std::map<std::shared_ptr<const Coefficients>, double> known;
};
} // namespace dem
