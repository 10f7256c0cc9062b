#pragma once

#include "specimen/shape_library.h"

#include <dem/particles/particle_system.h>

#include <filesystem>

namespace spall
{
/// Writes the particles as they are now into the folder of a run, so that
/// place_particles() reads them: particles.csv, in the order of the ids, and
/// the folder `shapes` with the series that it names. A particle that has
/// broken has a series of its own there. Without particles no files are
/// written, and those of an earlier state are removed in any case.
void write_last_state(const std::filesystem::path &folder,
                      const dem::ParticleSystem &all,
                      const ShapeLibrary &shapes);
} // namespace spall
