#include "surfaces.h"

#include <dem/contact/sum_grid.h>

#include <algorithm>
#include <cmath>

namespace dem
{
namespace
{
/// The next power of two.
double power_of_two(double x)
{
  return std::ldexp(1., static_cast<int>(std::ceil(std::log2(x))));
}

/// Force of a law where a sphere overlaps a plate [N].
double force_of(const LawChoice &choice, const PairElasticity &elasticity,
                const LargestLoad &largest)
{
  const ContactLaw &law = choice.entry();
  const HertzPrefactors unit = unit_prefactors(elasticity);
  const double root = std::sqrt(largest.radius);
  return std::abs(
      law.spring(choice.values,
                 {unit.normal * root, unit.tangential * root, largest.radius},
                 largest.overlap * largest.radius)
          .force);
}
} // namespace

SumGrid sum_grid(std::span<const LawChoice> laws,
                 const ElasticityTable &elasticity, std::size_t n_materials,
                 const LargestLoad &largest)
{
  double force = 0.;
  for (const LawChoice &law : laws)
    for (std::size_t m = 0; m < n_materials; ++m)
      force = std::max(
          force,
          force_of(law, elasticity.on_plate(static_cast<std::uint8_t>(m)),
                   largest));
  force = largest.factor * power_of_two(force);
  const double moment = force * power_of_two(largest.radius);
  // Losses are collected in units of 2^-80 J in the end (ExactSum).
  return {0x1p-50 * force, 0x1p-50 * moment,
          std::max(0x1p-50 * moment, 0x1p-80)};
}
} // namespace dem
