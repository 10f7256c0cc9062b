#include <coupling/deformable_body.h>

#include <algorithm>

namespace coupling
{
void DeformableBody::advance(FieldView load, double window,
                             const fem::NodeSprings *springs)
{
  start(load);
  if (springs)
    return implicit_step(load, window, *springs);
  const double time_step = window / scheme.n;
  for (int step = 0; step < scheme.n; ++step)
    if (scheme.is_implicit)
      implicit_step(load, time_step);
    else
    {
      begin_step(time_step);
      end_step(load, time_step);
    }
}

double
DeformableBody::squared_frequency(std::span<const double> stiffness) const
{
  const std::vector<double> mass = nodal_mass();
  double largest = 0.;
  for (std::size_t k = 0; k < mass.size(); ++k)
    largest = std::max(largest, stiffness[k] / mass[k]);
  return largest;
}
} // namespace coupling
