#include <fem/train_load.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <sstream>
#include <stdexcept>

namespace fem
{
namespace
{
[[noreturn]] void refuse(const std::string &what)
{
  throw std::invalid_argument("train: " + what);
}
} // namespace

std::vector<double> axle_distances(const Train &train)
{
  if (train.cars < 1)
    refuse("must have at least one car");
  std::vector<double> distances;
  for (int car = 0; car < train.cars; ++car)
    for (const double bogie : {0., train.bogie_spacing})
      for (const double axle : {0., train.axle_spacing})
        distances.push_back(car * train.car_length + bogie + axle);
  for (std::size_t k = 1; k < distances.size(); ++k)
    if (!(distances[k] > distances[k - 1]))
      refuse("axles must follow one another: 0 < axle_spacing < bogie_spacing "
             "and bogie_spacing + axle_spacing < car_length");
  return distances;
}

double train_load(const Train &train, std::span<const double> distances,
                  const AxleShare &share, double time)
{
  double sum = 0.;
  for (const double behind : distances)
    sum += share(train.speed * time - behind);
  return train.axle_load * sum;
}

double characteristic_length(const RailBed &bed)
{
  return std::pow(4. * bed.bending_stiffness / bed.track_modulus, 0.25);
}

double sleeper_share(const RailBed &bed, double x)
{
  const double length = characteristic_length(bed);
  const double s = std::abs(x) / length;
  return bed.sleeper_spacing / (2. * length) * std::exp(-s) *
         (std::cos(s) + std::sin(s));
}

ShareTable::ShareTable(const std::string &path)
{
  std::ifstream file(path);
  std::string line;
  if (!std::getline(file, line))
    throw std::invalid_argument(path + ": cannot be read");
  for (int number = 2; std::getline(file, line); ++number)
  {
    std::istringstream row(line);
    double x = 0., value = 0.;
    char comma = ' ';
    const bool is_row = bool(row >> x >> comma >> value) && comma == ',' &&
                        std::isfinite(x) && std::isfinite(value);
    const bool ascends = distance.empty() ? x == 0. : x > distance.back();
    if (!is_row || !ascends)
      throw std::invalid_argument(path + ", line " + std::to_string(number) +
                                  ": \"" + line +
                                  "\": must be distance_m,share_1 with "
                                  "distances that ascend from 0");
    distance.push_back(x);
    share.push_back(value);
  }
  if (distance.size() < 2)
    throw std::invalid_argument(path + ": must have two rows or more");
}

double ShareTable::operator()(double x) const
{
  const auto after =
      std::upper_bound(distance.begin(), distance.end(), std::abs(x));
  if (after == distance.end())
    return std::abs(x) == distance.back() ? share.back() : 0.;
  const auto k = static_cast<std::size_t>(after - distance.begin());
  const double part =
      (std::abs(x) - distance[k - 1]) / (distance[k] - distance[k - 1]);
  return std::lerp(share[k - 1], share[k], part);
}

double ShareTable::integral() const
{
  double sum = 0.;
  for (std::size_t k = 1; k < distance.size(); ++k)
    sum += (share[k] + share[k - 1]) * (distance[k] - distance[k - 1]);
  return sum;
}
} // namespace fem
