#pragma once

#include "case/case.h"

#include <fem/solid.h>

namespace spall
{
/// The cells of the ground, layers from the bottom up, sides as fem::BoxSide
/// and slanted_side. Throws InputError.
fem::SolidMesh ground_mesh(const Case &parameters);

/// The elastic block below z = 0 with its layers, supports and dashpots.
/// Throws InputError.
fem::Solid make_ground(const Case &parameters);
} // namespace spall
