#pragma once

#include <dem/shape/fit.h>

#include <cstdint>
#include <vector>

namespace dem::detail
{
/// Most corners that a face of a file may have.
inline constexpr std::size_t most_corners = 1000;

/// Cuts a polygon into triangles that face as it does: a quad along its
/// shorter diagonal inside, others ear by ear (Meisters 1975). `corners` are
/// numbers of points that the mesh has, from three to most_corners.
void add_polygon(const std::vector<std::int32_t> &corners, TriangleMesh &mesh);
} // namespace dem::detail
