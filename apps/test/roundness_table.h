#pragma once

#include <dem/measure/roundness_book.h>

#include <string>

namespace spall
{
/// id, size, loss and roundness of every particle, as the text of a CSV file;
/// steel balls are no particles.
std::string roundness_table(const dem::ParticleSystem &particles,
                            dem::RoundnessBook &roundness);

/// roundness_50s.csv: of the particles at this time of the test [s].
std::string roundness_file(double time);
} // namespace spall
