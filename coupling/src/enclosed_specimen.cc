#include <coupling/enclosed_specimen.h>
#include <dem/engine_boundaries.h>
#include <dem/measure/assembly.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace coupling
{
namespace
{
/// Layers of a profile in the diameter of the particle of mean volume.
constexpr double layers_per_particle = 5.;
/// Sections in a layer, and in all: points cost some microseconds.
constexpr double sections_per_layer = 2., fewest_sections = 40.,
                 most_sections = 120.;

/// The section where the membrane was put.
std::vector<Eigen::Vector2d> rim_of(const fem::Membrane &membrane)
{
  const std::vector<Eigen::Vector3d> &nodes = membrane.mesh().nodes;
  double low = nodes.front().z(), high = low;
  for (const Eigen::Vector3d &node : nodes)
  {
    low = std::min(low, node.z());
    high = std::max(high, node.z());
  }
  std::vector<Eigen::Vector2d> rim;
  for (const Eigen::Vector3d &node : nodes)
    if (node.z() < low + 1e-6 * (high - low))
      rim.emplace_back(node.head<2>());
  return dem::corners_through(rim);
}

/// Thickness of a layer of a profile, about [m].
double layer_of(const dem::ParticleSystem &particles)
{
  return std::cbrt(6. / std::numbers::pi *
                   dem::solid_volume(particles, *dem::one_rank()) /
                   static_cast<double>(particles.size())) /
         layers_per_particle;
}

/// Cut at n heights.
dem::Outline outline_of(const EnclosedSpecimen &specimen, int n)
{
  const dem::Prism space = space_of(specimen);
  return specimen.membrane ? dem::outline_of(dem::surface(specimen.engine),
                                             space.low, space.high, n)
                           : dem::outline_of(space, n);
}

int sections_for_layers(const EnclosedSpecimen &specimen)
{
  const dem::Prism space = space_of(specimen);
  const double distance =
      layer_of(specimen.engine.particles()) / sections_per_layer;
  return static_cast<int>(
      std::clamp(std::round((space.high - space.low) / distance),
                 fewest_sections, most_sections));
}
} // namespace

double enclosed_volume(const EnclosedSpecimen &specimen)
{
  return specimen.membrane ? specimen.membrane->enclosed_volume()
                           : dem::box_volume(specimen.engine, specimen.walls);
}

dem::Prism space_of(const EnclosedSpecimen &specimen)
{
  const auto [lower, upper] = dem::box_corners(specimen.engine, specimen.walls);
  if (specimen.walls.is_round() && !specimen.membrane)
    return dem::prism_of_cylinder(0.5 * (lower + upper).head<2>(),
                                  0.5 * (upper.x() - lower.x()), lower.z(),
                                  upper.z());
  dem::Prism space = dem::prism_of(lower, upper);
  if (specimen.membrane)
    space.corners = rim_of(*specimen.membrane);
  return space;
}

double skin_of(const EnclosedSpecimen &specimen)
{
  const dem::Prism space = space_of(specimen);
  Eigen::Vector2d lower = space.corners[0], upper = lower;
  for (const Eigen::Vector2d &corner : space.corners)
  {
    lower = lower.cwiseMin(corner);
    upper = upper.cwiseMax(corner);
  }
  const double least =
      std::min((upper - lower).minCoeff(), space.high - space.low);
  return std::min(2. * specimen.engine.particles().largest_radius(),
                  0.25 * least);
}

dem::BoundaryProfile boundary_profile(const EnclosedSpecimen &specimen)
{
  const dem::ParticleSystem &particles = specimen.engine.particles();
  return dem::boundary_profile(
      particles, dem::contact_network_of(specimen.engine),
      outline_of(specimen, sections_for_layers(specimen)),
      {layer_of(particles), skin_of(specimen)});
}

std::vector<double> section_areas(const EnclosedSpecimen &specimen)
{
  constexpr int n = 60; // the same for all, so that specimens compare
  return dem::section_areas(outline_of(specimen, n));
}
} // namespace coupling
