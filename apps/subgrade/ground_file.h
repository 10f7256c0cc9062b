#pragma once

#include "case/case.h"

#include <fem/solid_mesh.h>

namespace spall
{
/// Faces at the side that look along neither x nor y: a boundary besides those
/// of fem::BoxSide.
inline constexpr std::int32_t slanted_side = 6;

/// The ground as the file Subgrade/mesh has it. Its top is flat at z = 0, with
/// a node in the middle of the plate. Faces that look down more than aside are
/// its bottom, the rest its sides; all face away from the middle of the top.
/// Layers go by the depth of the cells' centres or, where the file has several
/// physical volumes, by their numbers: 1 is the top layer. Throws InputError.
fem::SolidMesh read_ground(const Case &parameters);
} // namespace spall
