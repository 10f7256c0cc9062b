#include "triaxial/network_state.h"

#include "run/csv_file.h"
#include "run/whole_file.h"

#include <dem/engine_boundaries.h>
#include <dem/measure/region_stress.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace spall
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
  return std::cbrt(6. / std::numbers::pi * solid_volume(particles) /
                   static_cast<double>(particles.size())) /
         layers_per_particle;
}

/// Cut at n heights.
dem::Outline outline_of(const Triaxial &test, int n)
{
  const dem::Prism space = space_of(test);
  return test.membrane() ? dem::outline_of(dem::surface(test.engine()),
                                           space.low, space.high, n)
                         : dem::outline_of(space, n);
}

int sections_for_layers(const Triaxial &test)
{
  const dem::Prism space = space_of(test);
  const double distance =
      layer_of(test.engine().particles()) / sections_per_layer;
  return static_cast<int>(
      std::clamp(std::round((space.high - space.low) / distance),
                 fewest_sections, most_sections));
}
} // namespace

dem::Prism space_of(const Triaxial &test)
{
  const auto [lower, upper] = dem::box_corners(test.engine(), test.walls());
  if (test.walls().is_round() && !test.membrane())
    return dem::prism_of_cylinder(0.5 * (lower + upper).head<2>(),
                                  0.5 * (upper.x() - lower.x()), lower.z(),
                                  upper.z());
  dem::Prism space = dem::prism_of(lower, upper);
  if (test.membrane())
    space.corners = rim_of(*test.membrane());
  return space;
}

double skin_of(const Triaxial &test)
{
  const dem::Prism space = space_of(test);
  Eigen::Vector2d lower = space.corners[0], upper = lower;
  for (const Eigen::Vector2d &corner : space.corners)
  {
    lower = lower.cwiseMin(corner);
    upper = upper.cwiseMax(corner);
  }
  const double least =
      std::min((upper - lower).minCoeff(), space.high - space.low);
  return std::min(2. * test.engine().particles().largest_radius(),
                  0.25 * least);
}

NetworkState network_state(const Triaxial &test)
{
  const dem::ParticleSystem &particles = test.engine().particles();
  const dem::Network network = dem::contact_network_of(test.engine());
  const Sample sample = test.sample(0.);
  const dem::Mat3 inside = dem::mean_stress(
      dem::without_skin(space_of(test), skin_of(test)), particles, network);
  const dem::ForceChains chains = dem::force_chains(particles, network);
  NetworkState state;
  state.coordination_number = sample.coordination_number;
  state.mean_contact_force = sample.mean_contact_force;
  state.strong_share = dem::strong_share(network.pairs);
  state.chain_share = chains.share;
  state.n_chains = static_cast<double>(chains.n_chains);
  state.chain_length = chains.mean_length;
  state.fabric_anisotropy =
      dem::fabric_anisotropy(dem::fabric_tensor(network.pairs));
  state.sliding_fraction = dem::sliding_fraction(network.pairs);
  state.inside_axial_stress = inside(2, 2);
  state.wall_axial_stress = sample.axial_stress;
  state.inside_lateral_stress = 0.5 * (inside(0, 0) + inside(1, 1));
  state.wall_lateral_stress = sample.lateral_stress;
  const dem::Mat3 in_particles = test.stress_balance().particles;
  state.specimen_axial_stress = axial(in_particles);
  state.specimen_lateral_stress = lateral(in_particles);
  state.membrane_axial_stress = sample.membrane_axial_stress;
  state.membrane_lateral_stress = sample.membrane_lateral_stress;
  return state;
}

dem::BoundaryProfile boundary_profile(const Triaxial &test)
{
  const dem::ParticleSystem &particles = test.engine().particles();
  return dem::boundary_profile(particles,
                               dem::contact_network_of(test.engine()),
                               outline_of(test, sections_for_layers(test)),
                               {layer_of(particles), skin_of(test)});
}

void write_profile(const std::filesystem::path &path,
                   const dem::BoundaryProfile &profile)
{
  const dem::LayerProfile &lateral = profile.lateral,
                          &platens = profile.platens;
  std::string text = "distance_m,porosity_lateral_1,coordination_lateral_1,"
                     "n_particles_lateral_1,porosity_platens_1,"
                     "coordination_platens_1,n_particles_platens_1\n";
  const std::vector<double> &distance =
      lateral.distance.size() > platens.distance.size() ? lateral.distance
                                                        : platens.distance;
  for (std::size_t k = 0; k < distance.size(); ++k)
  {
    std::vector<double> row = {distance[k]};
    for (const dem::LayerProfile *layers : {&lateral, &platens})
      for (const std::vector<double> *column :
           {&layers->porosity, &layers->coordination, &layers->n_particles})
        row.push_back(k < column->size()
                          ? (*column)[k]
                          : std::numeric_limits<double>::quiet_NaN());
    text += csv_row(row);
  }
  write_text(path, text);
}

std::vector<double> section_areas(const Triaxial &test)
{
  constexpr int n = 60; // the same for all, so that specimens compare
  return dem::section_areas(outline_of(test, n));
}

void write_sections(const std::filesystem::path &path,
                    std::span<const double> areas)
{
  std::string text = "height_share_1,section_m2\n";
  for (std::size_t k = 0; k < areas.size(); ++k)
    text += csv_row(
        {(static_cast<double>(k) + 0.5) / static_cast<double>(areas.size()),
         areas[k]});
  write_text(path, text);
}
} // namespace spall
