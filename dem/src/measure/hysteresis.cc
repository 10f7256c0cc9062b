#include <dem/measure/hysteresis.h>

#include <algorithm>
#include <limits>
#include <numbers>

namespace dem
{
void Hysteresis::begin(double strain, double stress)
{
  first = last = {strain, stress};
  area = 0.;
  largest_strain = strain_since = strain;
  largest_stress = least_stress = stress;
}

void Hysteresis::add(double strain, double stress)
{
  const Point next{strain, stress};
  area += work(last, next);
  last = next;
  if (strain > largest_strain)
    largest_strain = strain_since = strain;
  strain_since = std::min(strain_since, strain);
  largest_stress = std::max(largest_stress, stress);
  least_stress = std::min(least_stress, stress);
}

double Hysteresis::resilient_modulus() const
{
  return resilient_strain() > 0. ? cyclic_stress() / resilient_strain()
                                 : std::numeric_limits<double>::quiet_NaN();
}

double Hysteresis::damping_ratio() const
{
  const double stored = 0.125 * cyclic_stress() * resilient_strain();
  return stored > 0.
             ? (area + work(last, first)) / (4. * std::numbers::pi * stored)
             : std::numeric_limits<double>::quiet_NaN();
}

double Hysteresis::work(const Point &from, const Point &to)
{
  return 0.5 * (from.stress + to.stress) * (to.strain - from.strain);
}
} // namespace dem
