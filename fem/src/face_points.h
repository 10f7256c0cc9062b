#pragma once

#include <fem/solid_mesh.h>

#include <array>
#include <vector>

namespace fem
{
/// One point of integration on a face.
struct FacePoint
{
  Eigen::Vector3d position;      ///< [m]
  Eigen::Vector3d area;          ///< outward normal times area [m^2]
  std::array<double, 4> value{}; ///< of the functions of the corners [-]
};

/// 2 x 2 Gauss points in each of n_parts x n_parts parts of a face.
std::vector<FacePoint> face_points(const SolidMesh &mesh,
                                   const SolidMesh::Face &face, int n_parts);
} // namespace fem
