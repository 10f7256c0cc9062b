#pragma once

#include "run/whole_file.h"

#include <dem/parallel/ranks.h>

namespace spall
{
/// Calls `write` on all ranks, which may be collective: what the first one puts
/// out becomes a file, whole or not at all and synchronised; what others put
/// out is gone. Throws RunFailure on all ranks. Collective.
void write_of_all_ranks(const dem::Ranks &ranks,
                        const std::filesystem::path &path, Writers writers,
                        const std::function<void(std::ostream &)> &write);
} // namespace spall
