#include "subgrade/poured.h"

#include "run/digest.h"

namespace spall
{
namespace
{
std::string digest_of(const fem::SurfaceMesh &top, std::span<const double> mass)
{
  Digest digest;
  for (const Eigen::Vector3d &node : top.nodes)
    digest.add(std::span(node.data(), 3));
  for (const auto &quad : top.quads)
    for (const std::int32_t node : quad)
      digest.add(std::to_string(node) + " ");
  digest.add(mass);
  return hex_text(digest.value());
}
} // namespace

std::string poured_text(const Case &parameters, const ShapeLibrary &shapes,
                        const fem::SurfaceMesh &top,
                        std::span<const double> mass)
{
  std::vector<std::string> unused;
  if (parameters.container.has_mesh())
    unused = {"Layer/length", "Layer/width"};
  return preparation_text(parameters, shapes, parameters.subgrade.layer.safety,
                          unused) +
         "top of the ground = " + digest_of(top, mass) + "\n";
}
} // namespace spall
