#include "specimen/obtained_gradation.h"

#include "case/fields.h"
#include "case/file.h"
#include "case/parameter.h"
#include "errors.h"

#include <dem/packing/gradation.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <stdexcept>
#include <utility>

namespace spall
{
namespace
{
/// Where a kind of test names its gradation.
struct GradationKey
{
  std::string section, file;
};

std::optional<GradationKey> gradation_key(const Case &c)
{
  const std::string &section = find_kind(c.kind)->gradation_section;
  Case any = c;
  std::optional<GradationKey> key;
  for (const Parameter &parameter : parameters_of(any))
  {
    if (parameter.section != section || value_text(parameter).empty())
      continue;
    if (parameter.key == "particles") // placed, not drawn
      return {};
    if (parameter.key == "gradation")
      key = {section, value_text(parameter)};
  }
  return key;
}

Gradation read_table_of(const Case &c, const GradationKey &key)
{
  return read_gradation(find_path(c, key.section, "gradation", key.file));
}

/// The sieves of the table, and as many diameters between them as show the
/// curve.
ObtainedGradation asked_gradation(const Gradation &table)
{
  constexpr double fewest_steps = 20.;
  const auto &sieve = table.diameter;
  const double widest = std::log(sieve.back() / sieve.front()) / fewest_steps;
  ObtainedGradation rows;
  for (std::size_t k = 1; k < sieve.size(); ++k)
  {
    const double ratio = sieve[k] / sieve[k - 1];
    const double n = std::max(1., std::ceil(std::log(ratio) / widest - 1e-9));
    for (double step = 0.; step < n; ++step)
    {
      rows.diameter.push_back(sieve[k - 1] * std::pow(ratio, step / n));
      rows.asked.push_back(
          std::lerp(table.passing[k - 1], table.passing[k], step / n));
    }
  }
  rows.diameter.push_back(sieve.back());
  rows.asked.push_back(table.passing.back());
  return rows;
}

/// Diameter and mass of the particles [m, kg], from the smallest; steel balls
/// are left out.
std::vector<std::pair<double, double>>
sizes_of(const dem::ParticleSystem &particles)
{
  std::vector<std::pair<double, double>> sizes;
  for (std::size_t i = 0; i < particles.size(); ++i)
    if (particles.material[i] == 0)
      sizes.emplace_back(2. * particles.radius(i), particles.solid_mass(i));
  std::ranges::sort(sizes);
  return sizes;
}
} // namespace

std::vector<dem::ParticleShape> draw_particles(const Case &c,
                                               double solid_volume,
                                               const ShapeLibrary &shapes,
                                               dem::Random &random)
{
  const GradationKey key = gradation_key(c).value();
  const Gradation table = read_table_of(c, key);
  try
  {
    return dem::draw_particles({table.diameter, table.passing}, solid_volume,
                               shapes.series(), random);
  }
  catch (const std::invalid_argument &error)
  {
    throw InputError(c.file + ": " + key.section + "/gradation = " + key.file +
                     ": " + error.what() + "; its largest diameter is " +
                     largest_text(table));
  }
}

double ObtainedGradation::largest_difference() const
{
  double largest = 0.;
  for (std::size_t k = 0; k < diameter.size(); ++k)
    largest = std::max(largest, std::abs(obtained[k] - asked[k]));
  return largest;
}

std::optional<ObtainedGradation>
obtained_gradation(const Case &c, const dem::ParticleSystem &as_drawn)
{
  const auto key = gradation_key(c);
  const auto sizes = sizes_of(as_drawn);
  if (!key || sizes.empty())
    return {};
  ObtainedGradation rows = asked_gradation(read_table_of(c, *key));
  double mass = 0.;
  for (const auto &[diameter, its_mass] : sizes)
    mass += its_mass;
  double finer = 0.;
  std::size_t next = 0;
  for (const double diameter : rows.diameter)
  {
    const double opening = diameter * (1. + 1e-9); // round-off of a mean radius
    for (; next < sizes.size() && sizes[next].first <= opening; ++next)
      finer += sizes[next].second;
    rows.obtained.push_back(finer / mass);
    rows.one_particle.push_back(c.particle.density * std::numbers::pi / 6. *
                                std::pow(diameter, 3) / mass);
  }
  return rows;
}

std::string gradation_table(const ObtainedGradation &rows)
{
  std::string text =
      "diameter_m,asked_passing_1,obtained_passing_1,one_particle_1\n";
  for (std::size_t k = 0; k < rows.diameter.size(); ++k)
    text += number_text(rows.diameter[k]) + "," + number_text(rows.asked[k]) +
            "," + number_text(rows.obtained[k]) + "," +
            number_text(rows.one_particle[k]) + "\n";
  return text;
}

std::string gradation_line(const ObtainedGradation &rows)
{
  constexpr double notable = 0.05; // of the mass: a result may depend on it
  const double difference = rows.largest_difference(),
               largest = rows.diameter.back();
  char text[160];
  std::snprintf(text, sizeof text,
                "from %.4g to %.4g mm, the mass passing differs from the table "
                "by at most %.2g %%",
                1e3 * rows.diameter.front(), 1e3 * largest, 100. * difference);
  std::string line = text;
  if (difference > notable)
    line += "; WARNING: too few particles for this table";
  if (looks_like_millimetres(largest))
    line += "; WARNING: the diameters look like those of a table in mm, which "
            "must be divided by 1000";
  return line;
}
} // namespace spall
