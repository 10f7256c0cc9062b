#include <fem/train_load.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

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

ShareTable::ShareTable(std::vector<double> distances,
                       std::vector<double> shares)
    : distance(std::move(distances)), share(std::move(shares))
{
  if (distance.size() < 2 || distance.size() != share.size())
    throw std::invalid_argument("share table: must have two rows or more");
  for (std::size_t k = 0; k < distance.size(); ++k)
    if (k == 0 ? distance[k] != 0. : !(distance[k] > distance[k - 1]))
      throw std::invalid_argument("share table: row " + std::to_string(k + 1) +
                                  ": distances must ascend from 0");
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
