#pragma once

#include "shape/words.h"

namespace spall
{
/// spall shape corners: largest curvature and corners of a mesh and of its
/// series, side by side: a table, a picture and the shares of the surface.
int compare_shape_corners(const ShapeWords &words);
} // namespace spall
