#pragma once

#include <coupling/interface_map.h>

#include <string>

namespace spall
{
/// A surface of quads where it is now, with its displacement from the nodes of
/// the mesh [m] and its velocity [m/s] (vtu, text). Throws std::runtime_error
/// if it cannot be written.
void write_quads(const std::string &path, const fem::SurfaceMesh &mesh,
                 const coupling::NodeMotion &motion);
} // namespace spall
