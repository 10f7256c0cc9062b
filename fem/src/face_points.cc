#include "face_points.h"

#include <cmath>

namespace fem
{
namespace
{
FacePoint point_at(const std::array<Eigen::Vector3d, 4> &corners, double s,
                   double t)
{
  FacePoint point;
  point.value = {0.25 * (1. - s) * (1. - t), 0.25 * (1. + s) * (1. - t),
                 0.25 * (1. + s) * (1. + t), 0.25 * (1. - s) * (1. + t)};
  point.position.setZero();
  for (std::size_t v = 0; v < 4; ++v)
    point.position += point.value[v] * corners[v];
  const Eigen::Vector3d along_s = 0.25 * ((1. - t) * (corners[1] - corners[0]) +
                                          (1. + t) * (corners[2] - corners[3]));
  const Eigen::Vector3d along_t = 0.25 * ((1. - s) * (corners[3] - corners[0]) +
                                          (1. + s) * (corners[2] - corners[1]));
  point.area = along_s.cross(along_t);
  return point;
}
} // namespace

std::vector<FacePoint> face_points(const SolidMesh &mesh,
                                   const SolidMesh::Face &face, int n_parts)
{
  std::array<Eigen::Vector3d, 4> corners;
  for (std::size_t v = 0; v < 4; ++v)
    corners[v] = mesh.nodes[static_cast<std::size_t>(face.corners[v])];
  std::vector<double> abscissae;
  for (int part = 0; part < n_parts; ++part)
    for (const double side : {-1., 1.})
      abscissae.push_back((2. * part + 1. + side / std::sqrt(3.)) / n_parts -
                          1.);
  std::vector<FacePoint> points;
  for (const double t : abscissae)
    for (const double s : abscissae)
    {
      points.push_back(point_at(corners, s, t));
      points.back().area /= n_parts * n_parts;
    }
  return points;
}
} // namespace fem
