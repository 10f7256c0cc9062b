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
} // namespace

SumGrid sum_grid(double largest_force, double largest_radius)
{
  const double spacing = 0x1p-44 * power_of_two(largest_force);
  return {spacing, spacing * power_of_two(largest_radius)};
}

double usual_force(std::span<const LawChoice> laws,
                   const ElasticityTable &elasticity, std::size_t n_materials,
                   double radius)
{
  constexpr double overlap = 1e-4;
  double largest = 0.;
  for (const LawChoice &choice : laws)
    for (std::size_t m = 0; m < n_materials; ++m)
    {
      const HertzPrefactors unit =
          unit_prefactors(elasticity.on_plate(static_cast<std::uint8_t>(m)));
      const double root = std::sqrt(radius);
      const NormalSpring<double> spring = choice.entry().spring(
          choice.values, {unit.normal * root, unit.tangential * root, radius},
          overlap * radius);
      largest = std::max(largest, std::abs(spring.force));
    }
  return largest;
}
} // namespace dem
