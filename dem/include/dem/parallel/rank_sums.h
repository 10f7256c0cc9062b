#pragma once

#include <dem/contact/overlap_watch.h>
#include <dem/exact_sum.h>
#include <dem/neighbor/contact_point_lists.h>
#include <dem/parallel/ranks.h>

#include <span>

namespace dem
{
/// Sums entry by entry over all ranks, in one message: the same bits on any
/// number of ranks.
/// Throws std::overflow_error on all of them where a sum is out of range.
/// Collective.
void sum_over_ranks(const Ranks &ranks, std::span<ExactSum> sums,
                    std::span<std::int64_t> counts = {});

/// Sums and largest values of all ranks. Collective.
ContactPointEvents sum_over_ranks(const Ranks &ranks,
                                  const ContactPointEvents &own);
OverlapRecord largest_over_ranks(const Ranks &ranks, const OverlapRecord &own);

/// Whether any rank says so. Collective.
bool any_of_ranks(const Ranks &ranks, bool own);
} // namespace dem
