#pragma once

#include "test/removed_mass.h"

#include <dem/engine.h>

#include <span>
#include <string>
#include <utility>
#include <vector>

namespace spall
{
/// Columns of history.csv about the boundaries of a scene, each with its value
/// now: force and moment of the particles on each of them, and the mass that
/// particles have lost there; what sliding has dissipated on all planes, and on
/// each of the others. Moments are about this point; those on a wall of section
/// Walls are about its own centre. Collective.
std::vector<std::pair<std::string, double>>
boundary_quantities(const dem::Engine &engine,
                    std::span<const NamedBoundary> named,
                    const dem::Vec3 &about, const RemovedMass &removed);
} // namespace spall
