#pragma once

#include <fem/surface_mesh.h>

#include <span>

namespace fem
{
/// Rims of the surface as closed loops of nodes, each run through against the
/// sense of its quads, so that a lid on it faces outwards.
std::vector<std::vector<std::int32_t>> find_rims(const SurfaceMesh &mesh);

/// V = 1/3 int x.n dA over the bilinear quads and over lids made of triangles
/// from the mean of the nodes of each rim [m^3].
double enclosed_volume(const SurfaceMesh &mesh,
                       const std::vector<std::vector<std::int32_t>> &rims,
                       std::span<const Eigen::Vector3d> positions);
} // namespace fem
