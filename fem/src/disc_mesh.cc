#include <fem/disc_mesh.h>

#include <algorithm>
#include <cmath>

namespace fem
{
namespace
{
/// Adds the image of the mesh behind the plane x = 0 (axis 0) or y = 0 (axis
/// 1); faces in that plane are inside now.
SolidMesh mirrored(SolidMesh mesh, int axis)
{
  const double tolerance =
      1e-9 * std::ranges::max_element(mesh.nodes, {},
                                      [](const Eigen::Vector3d &x)
                                      { return x.norm(); })
                 ->norm();
  std::erase_if(mesh.faces, [&](const SolidMesh::Face &face)
                { return face.boundary == 2 * axis; });
  std::vector<std::int32_t> image;
  for (std::size_t k = 0, n = mesh.nodes.size(); k < n; ++k)
  {
    Eigen::Vector3d position = mesh.nodes[k];
    const bool is_shared = std::abs(position(axis)) < tolerance;
    image.push_back(
        static_cast<std::int32_t>(is_shared ? k : mesh.nodes.size()));
    position(axis) = -position(axis);
    if (!is_shared)
      mesh.nodes.push_back(position);
  }
  const auto of = [&](std::int32_t node)
  { return image[static_cast<std::size_t>(node)]; };
  const auto n_cells = mesh.cells.size(), n_faces = mesh.faces.size();
  for (std::size_t c = 0; c < n_cells; ++c)
  {
    std::array<std::int32_t, 8> cell{};
    for (std::size_t v = 0; v < 8; ++v) // an image is left-handed
      cell[v ^ 1] = of(mesh.cells[c][v]);
    mesh.cells.push_back(cell);
    mesh.layer.push_back(mesh.layer[c]);
  }
  for (std::size_t f = 0; f < n_faces; ++f)
  {
    SolidMesh::Face face = mesh.faces[f];
    for (std::int32_t &corner : face.corners)
      corner = of(corner);
    std::ranges::reverse(face.corners);
    face.cell += static_cast<std::int32_t>(n_cells);
    mesh.faces.push_back(face);
  }
  return mesh;
}
} // namespace

SolidMesh disc_mesh(const QuarterCylinder &quarter)
{
  return mirrored(mirrored(quarter_cylinder_mesh(quarter), 0), 1);
}

std::vector<double> area_shares(const SurfaceMesh &mesh)
{
  std::vector<double> share(mesh.nodes.size(), 0.);
  double whole = 0.;
  for (const auto &quad : mesh.quads)
  {
    const auto at = [&](std::size_t corner) -> const Eigen::Vector3d &
    { return mesh.nodes[static_cast<std::size_t>(quad[corner])]; };
    const double size = 0.5 * (at(2) - at(0)).cross(at(3) - at(1)).norm();
    whole += size;
    for (const std::int32_t node : quad)
      share[static_cast<std::size_t>(node)] += 0.25 * size;
  }
  for (double &one : share)
    one /= whole;
  return share;
}
} // namespace fem
