#include "case/parameter.h"
#include "errors.h"
#include "subgrade/subgrade.h"

#include <fem/solid_surface.h>

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>

namespace spall
{
/// Ground that yields need not bear what lies on it.
void Subgrade::lay_on_ground()
try
{
  if (solid)
    dead_stress = stresses_under(rest_load);
  balance_ground();
}
catch (const std::runtime_error &error)
{
  double largest = 0.;
  for (const dem::Vec3 &load : rest_load)
    largest = std::max(largest, load.norm());
  throw RunFailure("the ground does not bear plate and particles at rest, " +
                   number_text(std::round(now.dead_load)) + " N, of which " +
                   number_text(std::round(largest)) +
                   " N on one node: see Subgrade/layers, cell_size (" +
                   error.what() + ")");
}

/// Of the full ground at rest; it stays as it is [Pa].
std::vector<double> Subgrade::stresses_under(coupling::FieldView load)
{
  std::ostringstream before(std::ios::binary);
  solid->save(before);
  fem::Solid &body = solid->solid();
  coupling::Field all(body.mesh().nodes.size(), dem::Vec3::Zero());
  fem::add_loads(fem::boundary_surface(body.mesh(), fem::z_upper), load, all);
  body.settle(all);
  const std::vector<double> result = axis.stresses(body);
  std::istringstream back(std::move(before).str(), std::ios::binary);
  solid->restore(back);
  return result;
}

/// Lets the ground go, in balance with what lies on it.
void Subgrade::balance_ground()
{
  if (solid)
    solid->balance(rest_load);
  else
    condensed->balance(rest_load);
  joined->hold(*ground, false);
}
} // namespace spall
