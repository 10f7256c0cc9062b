#pragma once

#include <Eigen/Core>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

namespace support
{
/// A file of gmsh, format 2.2; `elements` are type, tags and nodes from one, as
/// words.
inline void write_gmsh(const std::filesystem::path &path,
                       const std::vector<Eigen::Vector3d> &nodes,
                       const std::vector<std::string> &elements)
{
  std::ofstream file(path);
  file.precision(17);
  file << "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n"
       << nodes.size() << "\n";
  for (std::size_t k = 0; k < nodes.size(); ++k)
    file << k + 1 << " " << nodes[k].transpose() << "\n";
  file << "$EndNodes\n$Elements\n" << elements.size() << "\n";
  for (std::size_t k = 0; k < elements.size(); ++k)
    file << k + 1 << " " << elements[k] << "\n";
  file << "$EndElements\n";
}
} // namespace support
