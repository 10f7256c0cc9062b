#include "subgrade/case.h"

#include "case/parameter.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>

namespace spall
{
namespace
{
std::vector<double> numbers_of(const std::string &text)
{
  std::istringstream words(text);
  std::vector<double> numbers;
  for (std::string word; words >> word;)
    numbers.push_back(to_number(word));
  return numbers;
}
} // namespace

std::vector<GroundLayer> parse_ground_layers(const std::string &text)
{
  const std::string allowed =
      "must be layers from the top down, separated by commas, each: thickness "
      "(m, above 0) Young's modulus (Pa, above 0) Poisson's ratio (0 to below "
      "0.5) density (kg/m^3, above 0); where it yields also cohesion (Pa, from "
      "0) friction angle (degrees, 0 to 60, not 0 without cohesion) and, 0 if "
      "left out, dilation angle (degrees, 0 to the friction angle)";
  std::vector<GroundLayer> layers;
  std::istringstream parts(text);
  for (std::string part; std::getline(parts, part, ',');)
  {
    std::vector<double> n;
    try
    {
      n = numbers_of(part);
    }
    catch (const std::invalid_argument &)
    {
      throw std::invalid_argument(allowed);
    }
    if ((n.size() != 4 && n.size() != 6 && n.size() != 7) || !(n[0] > 0.) ||
        !(n[1] > 0.) || !(n[2] >= 0.) || !(n[2] < 0.5) || !(n[3] > 0.))
      throw std::invalid_argument(allowed);
    GroundLayer &layer = layers.emplace_back();
    layer = {n[0], n[1], n[2], n[3]};
    if (n.size() == 4)
      continue;
    n.resize(7);
    if (!(n[4] >= 0.) || !(n[5] >= 0.) || !(n[5] <= 60.) || !(n[6] >= 0.) ||
        !(n[6] <= n[5]) || n[4] + n[5] == 0.)
      throw std::invalid_argument(allowed);
    layer.cohesion = n[4];
    layer.friction_angle = n[5];
    layer.dilatancy_angle = n[6];
  }
  if (layers.empty())
    throw std::invalid_argument(allowed);
  return layers;
}

std::vector<double> parse_depths(const std::string &text)
{
  const std::string allowed =
      "must be depths above 0 that ascend, in metres with blanks between, or "
      "empty";
  std::vector<double> depths;
  try
  {
    depths = numbers_of(text);
  }
  catch (const std::invalid_argument &)
  {
    throw std::invalid_argument(allowed);
  }
  double above = 0.;
  for (const double depth : depths)
  {
    if (!(depth > above))
      throw std::invalid_argument(allowed);
    above = depth;
  }
  return depths;
}

bool yields(const GroundParameters &ground)
{
  return std::ranges::any_of(parse_ground_layers(ground.layers),
                             [](const GroundLayer &layer)
                             { return std::isfinite(layer.cohesion); });
}

std::vector<double> layer_tops(const GroundParameters &ground)
{
  std::vector<double> tops;
  double top = 0.;
  for (const GroundLayer &layer : parse_ground_layers(ground.layers))
  {
    tops.push_back(top);
    top -= layer.thickness;
  }
  std::ranges::reverse(tops);
  return tops;
}

double depth_of(const GroundParameters &ground)
{
  double sum = 0.;
  for (const GroundLayer &layer : parse_ground_layers(ground.layers))
    sum += layer.thickness;
  return sum;
}

Footprint footprint(const LoadPlateParameters &plate)
{
  if (plate.form == PlateForm::disc)
    return {0.5 * plate.diameter, 0.5 * plate.diameter};
  return {0.5 * plate.length, 0.5 * plate.width};
}
} // namespace spall
