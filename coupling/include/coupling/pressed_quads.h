#pragma once

#include <dem/measure/network.h>
#include <fem/surface_mesh.h>

#include <cstdint>
#include <vector>

namespace coupling
{
/// The quads that particles press on: those nearer to a contact with a boundary
/// than a twentieth of their longer diagonal. In order.
std::vector<std::int32_t> pressed_quads(const fem::SurfaceMesh &mesh,
                                        const dem::Network &network);
} // namespace coupling
