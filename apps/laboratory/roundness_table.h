#pragma once

#include <dem/measure/roundness_book.h>

#include <string>

namespace spall
{
/// id, size, loss and roundness of every stone, as the text of a CSV file;
/// steel balls are no stones.
std::string roundness_table(const dem::Particles &stones,
                            dem::RoundnessBook &roundness);

/// roundness_50s.csv: of the stones at this time of the test [s].
std::string roundness_file(double time);
} // namespace spall
