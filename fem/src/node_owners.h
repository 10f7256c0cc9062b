#pragma once

#include <fem/solid_mesh.h>

namespace fem
{
/// The part, from 0, that each node belongs to when the nodes are divided into
/// so many parts of about the same size with few cells between them (METIS;
/// Karypis and Kumar 1998). The same on every rank.
std::vector<int> divide_nodes(const SolidMesh &mesh, int n_parts);
} // namespace fem
