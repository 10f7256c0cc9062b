#include "enclosed_volume.h"

#include <cmath>
#include <map>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>

namespace fem
{
namespace
{
/// Each node of a rim with the one that follows it on the lid.
std::map<std::int32_t, std::int32_t> rim_edges(const SurfaceMesh &mesh)
{
  std::set<std::pair<std::int32_t, std::int32_t>> edges;
  for (const auto &quad : mesh.quads)
    for (std::size_t v = 0; v < 4; ++v)
      edges.emplace(quad[v], quad[(v + 1) % 4]);
  // The edge of a larger quad is that of the two smaller ones beside it.
  for (const auto &[node, ends] : mesh.midpoints)
    for (const auto &[from, to] :
         {std::pair(ends[0], ends[1]), std::pair(ends[1], ends[0])})
      if (edges.erase({from, to}) > 0)
      {
        edges.emplace(from, node);
        edges.emplace(node, to);
      }
  std::map<std::int32_t, std::int32_t> next;
  for (const auto &[from, to] : edges)
    if (!edges.contains({to, from}) && !next.emplace(to, from).second)
      throw std::invalid_argument("membrane mesh: two rims meet in node " +
                                  std::to_string(to));
  return next;
}

/// 1/3 int x.n dA = 1/3 int x.(a x b): 2 x 2 Gauss points are exact.
double bilinear_share(const std::array<Eigen::Vector3d, 4> &x)
{
  const double g = 0.5 / std::sqrt(3.);
  double sum = 0.;
  for (const double r : {0.5 - g, 0.5 + g})
    for (const double s : {0.5 - g, 0.5 + g})
    {
      const Eigen::Vector3d along_r =
          (1. - s) * (x[1] - x[0]) + s * (x[2] - x[3]);
      const Eigen::Vector3d along_s =
          (1. - r) * (x[3] - x[0]) + r * (x[2] - x[1]);
      const Eigen::Vector3d point = (1. - r) * ((1. - s) * x[0] + s * x[3]) +
                                    r * ((1. - s) * x[1] + s * x[2]);
      sum += point.dot(along_r.cross(along_s)) / 12.;
    }
  return sum;
}
} // namespace

std::vector<std::vector<std::int32_t>> find_rims(const SurfaceMesh &mesh)
{
  std::map<std::int32_t, std::int32_t> next = rim_edges(mesh);
  std::vector<std::vector<std::int32_t>> rims;
  while (!next.empty())
  {
    rims.emplace_back();
    for (auto edge = next.begin(); edge != next.end();)
    {
      const std::int32_t to = edge->second;
      rims.back().push_back(edge->first);
      next.erase(edge);
      edge = next.find(to);
    }
  }
  return rims;
}

double enclosed_volume(const SurfaceMesh &mesh,
                       const std::vector<std::vector<std::int32_t>> &rims,
                       std::span<const Eigen::Vector3d> positions)
{
  // Taken about a node: far from the origin the sum would lose digits.
  const Eigen::Vector3d origin = positions[0];
  const auto at = [&](std::int32_t node) -> Eigen::Vector3d
  { return positions[static_cast<std::size_t>(node)] - origin; };

  double volume = 0.;
  for (const auto &quad : mesh.quads)
    volume +=
        bilinear_share({at(quad[0]), at(quad[1]), at(quad[2]), at(quad[3])});
  for (const auto &rim : rims)
  {
    Eigen::Vector3d centre = Eigen::Vector3d::Zero();
    for (const std::int32_t node : rim)
      centre += at(node) / static_cast<double>(rim.size());
    for (std::size_t k = 0; k < rim.size(); ++k)
      volume +=
          centre.dot(at(rim[k]).cross(at(rim[(k + 1) % rim.size()]))) / 6.;
  }
  return volume;
}
} // namespace fem
