#include <fem/surface_mesh.h>

#include <algorithm>
#include <map>
#include <stdexcept>
#include <string>
#include <utility>

namespace fem
{
namespace
{
using Edge = std::pair<std::int32_t, std::int32_t>;

std::size_t index(std::int32_t number)
{
  return static_cast<std::size_t>(number);
}

/// Marks of the quads that are asked for.
std::vector<bool> marks_of(const SurfaceMesh &mesh,
                           std::span<const std::int32_t> quads)
{
  if (!mesh.midpoints.empty())
    throw std::invalid_argument("halve_quads: the mesh has midpoints already");
  std::vector<bool> is_halved(mesh.quads.size(), false);
  for (const std::int32_t quad : quads)
  {
    if (quad < 0 || index(quad) >= is_halved.size())
      throw std::invalid_argument("halve_quads: quad " + std::to_string(quad) +
                                  ", there are " +
                                  std::to_string(is_halved.size()));
    is_halved[index(quad)] = true;
  }
  return is_halved;
}

/// Nodes in the middle of edges, each made when it is first asked for.
class Middles
{
public:
  explicit Middles(SurfaceMesh &its_mesh) : mesh(its_mesh) {}

  std::int32_t of(std::int32_t a, std::int32_t b)
  {
    const auto [found, is_new] = middle.try_emplace(
        std::minmax(a, b), static_cast<std::int32_t>(mesh.nodes.size()));
    if (is_new)
      mesh.nodes.emplace_back(0.5 *
                              (mesh.nodes[index(a)] + mesh.nodes[index(b)]));
    return found->second;
  }
  /// Those in edges of these quads, which are left whole, hang there.
  void hang_on(const std::vector<std::array<std::int32_t, 4>> &whole)
  {
    for (const auto &quad : whole)
      for (std::size_t v = 0; v < 4; ++v)
        if (const auto found =
                middle.find(std::minmax(quad[v], quad[(v + 1) % 4]));
            found != middle.end())
          mesh.midpoints.push_back(
              {found->second, {quad[v], quad[(v + 1) % 4]}});
  }

private:
  SurfaceMesh &mesh;
  std::map<Edge, std::int32_t> middle;
};
} // namespace

SurfaceMesh halve_quads(const SurfaceMesh &mesh,
                        std::span<const std::int32_t> quads)
{
  const std::vector<bool> is_halved = marks_of(mesh, quads);
  SurfaceMesh halved{mesh.nodes, {}, {}};
  std::vector<std::array<std::int32_t, 4>> whole;
  Middles middles(halved);
  for (std::size_t k = 0; k < mesh.quads.size(); ++k)
  {
    const auto &quad = mesh.quads[k];
    if (!is_halved[k])
    {
      whole.push_back(quad);
      halved.quads.push_back(quad);
      continue;
    }
    std::array<std::int32_t, 4> middle{};
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (std::size_t v = 0; v < 4; ++v)
    {
      middle[v] = middles.of(quad[v], quad[(v + 1) % 4]);
      sum += mesh.nodes[index(quad[v])];
    }
    const auto centre = static_cast<std::int32_t>(halved.nodes.size());
    halved.nodes.emplace_back(0.25 * sum);
    for (std::size_t v = 0; v < 4; ++v)
      halved.quads.push_back({quad[v], middle[v], centre, middle[(v + 3) % 4]});
  }
  middles.hang_on(whole);
  return halved;
}
} // namespace fem
