#pragma once

#include <dem/contact/batch.h>

#include <cstdint>
#include <vector>

namespace dem
{
/// How the loads of the pairs come together, the same for any number of
/// threads. The contacts are cut into ranges of one length. The stones strictly
/// between the first stone A of a range and that of the next are its own: only
/// this range adds to them. What it does to another stone B it sums up in a
/// halo row of its own; halo rows are added at the end, by stone, then by
/// range.
class PairLoads
{
public:
  /// Sets ContactBatch::target: a stone, or -1 - row of the halo.
  void prepare(ContactBatch &pairs);

  StoneLoad *halo_rows() { return halo.data(); }
  /// Adds the halo to the loads of the stones; it is zero then.
  void add_halo(std::vector<StoneLoad> &load);

private:
  std::vector<StoneLoad> halo;
  std::vector<std::int32_t> stone; ///< that have halo rows, in order
  std::vector<std::int32_t> start; ///< their first row, and the number of rows
};

/// Contacts of a range: some 32 ranges, of few contacts eight, neither so short
/// that their ends and halos cost nor so long that a thread gets none; a
/// multiple of ContactBatch::block.
std::int64_t range_size(std::int64_t n_contacts);
} // namespace dem
