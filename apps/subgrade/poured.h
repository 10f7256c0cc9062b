#pragma once

#include "run/preparation_text.h"

#include <fem/surface_mesh.h>

#include <span>

namespace spall
{
/// Every key of a case of kind subgrade is in one of the two lists.
const PreparationKeys &poured_keys();

/// All that decides the poured particles: while they fall the ground is held,
/// so of it only the mesh of its top counts, with the masses of the nodes there
/// [kg].
std::string poured_text(const Case &parameters, const ShapeLibrary &shapes,
                        const fem::SurfaceMesh &top,
                        std::span<const double> mass);
} // namespace spall
