#pragma once

#include "parts_stream.h"

namespace dem
{
/// Brings the particles of all ranks to the first one, with their contacts and
/// in the order of the ids: all at once, or one block after the other, so that
/// no rank ever has more than its own and one block. The particles must not
/// change meanwhile.
class SceneBlocks
{
public:
  /// Copies the pairs of this rank, to name their partners by id.
  SceneBlocks(Distribution &distribution, const DistributedParts &own);

  /// On the first rank, appends copies of the particles from id `first` to
  /// before `end` to `into`, which has none; others stay empty. Partners are
  /// named by id. Collective.
  void take(std::int64_t first, std::int64_t end, const DistributedParts &into);

private:
  Distribution &among;
  ContactBatch pairs;
  std::vector<CandidatePair> candidates;
  DistributedParts named;
};
} // namespace dem
