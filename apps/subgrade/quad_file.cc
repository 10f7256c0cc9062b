#include "subgrade/quad_file.h"

namespace spall
{
namespace
{
void write_vectors(std::ostream &out, const std::string &name,
                   coupling::FieldView field)
{
  out << "<DataArray type=\"Float64\" Name=\"" << name
      << "\" NumberOfComponents=\"3\" format=\"ascii\">\n";
  for (const Eigen::Vector3d &v : field)
    out << v.x() << ' ' << v.y() << ' ' << v.z() << '\n';
  out << "</DataArray>\n";
}

template <class Value>
void write_integers(std::ostream &out, const std::string &name,
                    const std::string &type, std::size_t n, const Value &value)
{
  out << "<DataArray type=\"" << type << "\" Name=\"" << name
      << "\" format=\"ascii\">\n";
  for (std::size_t k = 0; k < n; ++k)
    out << value(k) << '\n';
  out << "</DataArray>\n";
}
} // namespace

void write_quads(std::ostream &out, const fem::SurfaceMesh &mesh,
                 const coupling::NodeMotion &motion)
{
  out.precision(9);
  coupling::Field displacement(motion.position.begin(), motion.position.end());
  for (std::size_t k = 0; k < displacement.size(); ++k)
    displacement[k] -= mesh.nodes[k];
  const std::size_t n = mesh.quads.size();
  out << "<VTKFile type=\"UnstructuredGrid\" version=\"1.0\">\n"
         "<UnstructuredGrid>\n<Piece NumberOfPoints=\""
      << motion.position.size() << "\" NumberOfCells=\"" << n
      << "\">\n<PointData>\n";
  write_vectors(out, "displacement_m", displacement);
  write_vectors(out, "velocity_m_per_s", motion.velocity);
  out << "</PointData>\n<Points>\n";
  write_vectors(out, "points", motion.position);
  out << "</Points>\n<Cells>\n";
  write_integers(out, "connectivity", "Int32", 4 * n,
                 [&](std::size_t k) { return mesh.quads[k / 4][k % 4]; });
  write_integers(out, "offsets", "Int32", n,
                 [](std::size_t k) { return 4 * (k + 1); });
  write_integers(out, "types", "UInt8", n, [](std::size_t) { return 9; });
  out << "</Cells>\n</Piece>\n</UnstructuredGrid>\n</VTKFile>\n";
}
} // namespace spall
