#pragma once

#include <fem/solid_mesh.h>
#include <fem/surface_mesh.h>

namespace fem
{
/// The whole of the round block of which that is a quarter; x_upper is its
/// round side.
SolidMesh disc_mesh(const QuarterCylinder &quarter);

/// Share of the area of the surface that belongs to each node: a quarter of
/// every quad that it is a corner of [-].
std::vector<double> area_shares(const SurfaceMesh &mesh);
} // namespace fem
