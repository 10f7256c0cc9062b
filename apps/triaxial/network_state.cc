#include "triaxial/network_state.h"

#include "run/csv_file.h"
#include "triaxial/triaxial.h"

#include <limits>

namespace spall
{
NetworkState network_state(const Triaxial &test)
{
  const Sample sample = test.sample(0.);
  return test.of_whole(
      [&](const dem::Engine &scene)
      {
        return coupling::network_state(
            test.enclosed(scene), test.stress_balance(scene),
            {sample.axial_stress, sample.lateral_stress});
      });
}

std::string profile_table(const dem::BoundaryProfile &profile)
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
  return text;
}

std::string sections_table(std::span<const double> areas)
{
  std::string text = "height_share_1,section_m2\n";
  for (std::size_t k = 0; k < areas.size(); ++k)
    text += csv_row(
        {(static_cast<double>(k) + 0.5) / static_cast<double>(areas.size()),
         areas[k]});
  return text;
}
} // namespace spall
