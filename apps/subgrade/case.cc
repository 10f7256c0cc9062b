#include "subgrade/case.h"

#include "case/parameter.h"

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
      "0.5) density (kg/m^3, above 0)";
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
    if (n.size() != 4 || !(n[0] > 0.) || !(n[1] > 0.) || !(n[2] >= 0.) ||
        !(n[2] < 0.5) || !(n[3] > 0.))
      throw std::invalid_argument(allowed);
    layers.push_back({n[0], n[1], n[2], n[3]});
  }
  if (layers.empty())
    throw std::invalid_argument(allowed);
  return layers;
}

std::vector<double> parse_depths(const std::string &text)
{
  const std::string allowed =
      "must be depths above 0 that ascend, in metres, or empty";
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
