#include "test/roundness_table.h"

#include "case/parameter.h"

#include <cstdio>
#include <vector>

namespace spall
{
namespace
{
std::string table_of(const dem::ParticleSystem &particles,
                     dem::RoundnessBook &roundness)
{
  std::vector<std::string> rows(particles.size());
  for (std::size_t i = 0; i < particles.size(); ++i)
  {
    if (particles.material[i] != 0)
      continue;
    std::string &row = rows[static_cast<std::size_t>(particles.id[i])];
    row = std::to_string(particles.id[i]);
    for (const double value :
         {2. * particles.radius(i), particles.solid_mass(i),
          1. - particles.solid_mass(i) / particles.initial_mass[i],
          roundness.of(particles.shape[i])})
      row += "," + number_text(value);
  }
  std::string text = "id_1,diameter_m,mass_kg,mass_loss_1,roundness_1\n";
  for (const std::string &row : rows)
    text += row.empty() ? "" : row + "\n";
  return text;
}
} // namespace

std::string roundness_table(const Test &test, dem::RoundnessBook &roundness)
{
  std::string text;
  test.with_whole([&](const dem::Engine &scene)
                  { text = table_of(scene.particles(), roundness); });
  return text;
}

std::string roundness_file(double time)
{
  char name[40];
  std::snprintf(name, sizeof name, "roundness_%.6gs.csv", time);
  return name;
}
} // namespace spall
