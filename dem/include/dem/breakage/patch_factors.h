#pragma once

#include <dem/contact/batch.h>
#include <dem/shape/direction_grid.h>

#include <vector>

namespace dem
{
/// Cumulative factors that contacts have left on the surfaces of their
/// particles: one for each patch of about 11 degrees. The next contact there
/// takes it.
class PatchFactors
{
public:
  static constexpr DirectionGrid patches{16, 32};

  /// Contacts that ended leave their factors, those that began take what is
  /// there, one after the other: of the batch those that its loop has marked
  /// (ContactBatch::event, bit 2).
  void exchange(const ParticleSystem &particles, ContactBatch &batch);

  /// By id of the particle, then patch; grows with use [-].
  std::vector<double> factors;

private:
  void exchange_side(std::int64_t particle, const Triple<double> &on_body,
                     bool begins, double &factor);
};
} // namespace dem
