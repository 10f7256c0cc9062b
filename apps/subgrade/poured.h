#pragma once

#include "test/preparation_text.h"

#include <fem/surface_mesh.h>

#include <span>

namespace spall
{
/// All that decides the poured particles: while they fall the ground is held,
/// so of it only the mesh of its top counts, with the masses of the nodes there
/// [kg].
std::string poured_text(const Case &parameters, const ShapeLibrary &shapes,
                        const fem::SurfaceMesh &top,
                        std::span<const double> mass);
} // namespace spall
