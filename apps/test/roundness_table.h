#pragma once

#include "test/test.h"

#include <dem/measure/roundness_book.h>

#include <string>

namespace spall
{
/// id, size, loss and roundness of every particle of all ranks, as the text of
/// a CSV file on the first rank; steel balls are no particles. Collective.
std::string roundness_table(const Test &test, dem::RoundnessBook &roundness);

/// roundness_50s.csv: of the particles at this time of the test [s].
std::string roundness_file(double time);
} // namespace spall
