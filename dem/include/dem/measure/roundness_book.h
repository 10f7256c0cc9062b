#pragma once

#include <dem/particles.h>

#include <map>
#include <memory>

namespace dem
{
/// Roundness R_g of stones (Eq. 30). Remembers the shapes that it has
/// evaluated, so that only stones that have broken since cost anything; the
/// numbers are those of a new book, bit for bit.
class RoundnessBook
{
public:
  /// 1 of a sphere [-].
  double of(const Body &body);

  /// Mean of the stones with shapes, weighed by volume; 1 without any [-].
  double mean(const Particles &particles);

private:
  /// Unbroken stones of one shape have one roundness, whatever their scale.
  std::map<std::shared_ptr<const Coefficients>, double> known;
};
} // namespace dem
