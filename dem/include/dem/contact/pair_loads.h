#pragma once

#include <dem/contact/batch.h>

#include <cstdint>
#include <vector>

namespace dem
{
/// How the loads of the pairs come together, the same for any number of
/// threads. The contacts are cut into ranges of one length. The particles
/// strictly between the first particle A of a range and that of the next are
/// its own: only this range adds to them. What it does to another particle B it
/// sums up in a halo row of its own; halo rows are added at the end, by
/// particle, then by range.
class PairLoads
{
public:
  /// Sets ContactBatch::target: a particle, or -1 - row of the halo.
  void prepare(ContactBatch &pairs);

  ParticleLoad *halo_rows() { return halo.data(); }
  /// Adds the halo to the loads of the particles; it is zero then.
  void add_halo(std::vector<ParticleLoad> &load);

private:
  std::vector<ParticleLoad> halo;
  std::vector<std::int32_t> particle; ///< that have halo rows, in order
  std::vector<std::int32_t> start; ///< their first row, and the number of rows
};

/// Contacts of a range: some 32 ranges, of few contacts eight, neither so short
/// that their ends and halos cost nor so long that a thread gets none; a
/// multiple of ContactBatch::block.
std::int64_t range_size(std::int64_t n_contacts);
} // namespace dem
