#pragma once

#include <coupling/interface_map.h>

#include <ostream>

namespace spall
{
/// A surface of quads where it is now, with its displacement from the nodes of
/// the mesh [m] and its velocity [m/s] (vtu, text).
void write_quads(std::ostream &out, const fem::SurfaceMesh &mesh,
                 const coupling::NodeMotion &motion);
} // namespace spall
