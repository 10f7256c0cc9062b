#pragma once

#include "case/case.h"

#include <dem/vector.h>
#include <fem/surface_mesh.h>

namespace spall
{
/// The membrane as the file Boundary/mesh has it, stretched to a specimen
/// between these corners. In the file it is the side of an upright box, or of a
/// cylinder round the z axis, from one flat rim to the other, in any unit and
/// with quads of any size. Throws InputError.
fem::SurfaceMesh read_sheet(const Case &parameters, const dem::Vec3 &lower,
                            const dem::Vec3 &upper);
} // namespace spall
