#pragma once

#include "case/case.h"

#include <dem/packing/pouring.h>

namespace spall
{
/// Where the layer is poured: the box, or the container of Container/mesh, on
/// the ground at z = 0. Throws InputError.
dem::Room layer_room(const Case &parameters);

/// Where it stands on the ground, seen from above.
dem::Polygon foot_of(const dem::Room &room);

/// Its sides: four planes x_min, x_max, y_min, y_max, or a mesh wall.
void add_sides(const Case &parameters, const dem::Room &room,
               dem::Engine &engine);
} // namespace spall
