#include "triaxial/network_state.h"

#include "run/folder.h"

#include <dem/measure/region_stress.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace spall
{
namespace
{
/// Between two sections of a specimen: a hundredth of its height.
constexpr int n_sections = 100;
/// Layers of a profile in the diameter of the stone of mean volume.
constexpr double layers_per_stone = 5.;

/// The box between the planes, the upper one of which is the plate. A membrane
/// has begun at the lateral ones.
std::array<dem::Vec3, 2> box_of(const Triaxial &test)
{
  std::array<dem::Vec3, 2> corners;
  for (std::size_t end = 0; end < 2; ++end)
    for (int d = 0; d < 3; ++d)
      corners[end][d] =
          test.engine()
              .planes()[test.box()[static_cast<std::size_t>(d)][end]]
              .point[d];
  return corners;
}

double mean_diameter(const dem::Particles &stones)
{
  return std::cbrt(6. / std::numbers::pi * solid_volume(stones) /
                   static_cast<double>(stones.size()));
}

dem::Outline outline_of(const Triaxial &test)
{
  const auto [lower, upper] = box_of(test);
  return test.membrane() ? dem::outline_of(test.engine().surface(), lower.z(),
                                           upper.z(), n_sections)
                         : dem::outline_of(lower, upper, n_sections);
}
} // namespace

double skin_of(const Triaxial &test)
{
  const auto [lower, upper] = box_of(test);
  return std::min(2. * test.engine().particles().largest_radius(),
                  0.25 * (upper - lower).minCoeff());
}

NetworkState network_state(const Triaxial &test)
{
  const dem::Particles &stones = test.engine().particles();
  const dem::Network network = dem::contact_network_of(test.engine());
  const Sample sample = test.sample(0.);
  const auto [lower, upper] = box_of(test);
  const dem::Mat3 inside = dem::mean_stress(
      dem::without_skin(dem::prism_of(lower, upper), skin_of(test)), stones,
      network);
  const dem::ForceChains chains = dem::force_chains(stones, network);
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
  return state;
}

dem::BoundaryProfile boundary_profile(const Triaxial &test)
{
  const dem::Particles &stones = test.engine().particles();
  return dem::boundary_profile(
      stones, dem::contact_network_of(test.engine()), outline_of(test),
      {mean_diameter(stones) / layers_per_stone, skin_of(test)});
}

void write_profile(const std::filesystem::path &path,
                   const dem::BoundaryProfile &profile)
{
  const dem::LayerProfile &lateral = profile.lateral,
                          &platens = profile.platens;
  CsvFile file;
  file.open(path, "distance_m,porosity_lateral_1,coordination_lateral_1,"
                  "n_stones_lateral_1,porosity_platens_1,"
                  "coordination_platens_1,n_stones_platens_1");
  const std::vector<double> &distance =
      lateral.distance.size() > platens.distance.size() ? lateral.distance
                                                        : platens.distance;
  for (std::size_t k = 0; k < distance.size(); ++k)
  {
    std::vector<double> row = {distance[k]};
    for (const dem::LayerProfile *layers : {&lateral, &platens})
      for (const std::vector<double> *column :
           {&layers->porosity, &layers->coordination, &layers->n_stones})
        row.push_back(k < column->size()
                          ? (*column)[k]
                          : std::numeric_limits<double>::quiet_NaN());
    file.write_row(row);
  }
}
} // namespace spall
