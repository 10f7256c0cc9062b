#include "subgrade/poured.h"

#include "run/digest.h"

namespace spall
{
namespace
{
/// Friction among particles is Layer/friction, and that of Particle for their
/// last rest; damping is Layer/local_damping.
constexpr CaseKey deciding[] = {
    {"Layer"}, {"GroundContact"}, {"Particle", "friction"}};

/// Of plate and ground what makes the top of the ground counts by that.
constexpr CaseKey later[] = {
    {"LoadPlate"}, {"Subgrade"}, {"Pulse"}, {"Record"}};

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

const PreparationKeys &poured_keys()
{
  static const PreparationKeys keys(deciding, later);
  return keys;
}

std::string poured_text(const Case &parameters, const ShapeLibrary &shapes,
                        const fem::SurfaceMesh &top,
                        std::span<const double> mass)
{
  return preparation_text(parameters, poured_keys(), shapes,
                          parameters.subgrade.layer.safety,
                          [](const Parameter &) { return false; }) +
         "top of the ground = " + digest_of(top, mass) + "\n";
}
} // namespace spall
