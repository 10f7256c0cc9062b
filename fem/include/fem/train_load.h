#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

namespace fem
{
/// A train of equal cars with two bogies of two axles each.
struct Train
{
  double axle_load = 100e3;      ///< P, of one axle [N]
  double axle_spacing = 2.5;     ///< of the two axles of a bogie [m]
  double bogie_spacing = 17.375; ///< of the two bogies of a car, centres [m]
  double car_length = 24.775;    ///< from car to car [m]
  int cars = 1;
  double speed = 50.; ///< v [m/s]
};

/// Distance of every axle behind the first one, ascending [m]. Throws
/// std::invalid_argument on a train that has none or whose axles coincide or
/// pass one another.
std::vector<double> axle_distances(const Train &train);

/// Share of an axle load that a sleeper gets over its distance from the axle,
/// before or behind it [m] -> [-].
using AxleShare = std::function<double(double)>;

/// Load on a sleeper at a time after the first axle stood on it (negative:
/// before): sum over the axles of P share(v t - distance) [N]. Its impulse is
/// P / v times the number of axles times the integral of the share.
double train_load(const Train &train, std::span<const double> distances,
                  const AxleShare &share, double time);

/// Rail on an elastic foundation (Winkler; Zimmermann 1888).
struct RailBed
{
  double bending_stiffness = 6.4e6; ///< E I of one rail [N m^2]
  double track_modulus = 40e6;      ///< u: force per length and deflection of
                                    ///< one rail [N/m^2]
  double sleeper_spacing = 0.6;     ///< a [m]
};

/// L = (4 E I / u)^(1/4) [m].
double characteristic_length(const RailBed &bed);

/// Share of an axle load that the sleeper at a distance x along the track gets
/// [-]: a / (2 L) exp(-|x| / L) (cos(|x| / L) + sin(|x| / L)), the pressure of
/// the foundation over the spacing of the sleepers. Beyond 3 pi / 4 L it is
/// negative, the rail lifts. Both rails carry half the axle, so the share is
/// that of the sleeper.
double sleeper_share(const RailBed &bed, double x);

/// Share over distance by straight lines between rows; beyond the last one
/// zero.
class ShareTable
{
public:
  /// Throws std::invalid_argument unless there are two rows or more and the
  /// distances ascend from 0.
  ShareTable(std::vector<double> distance, std::vector<double> share);
  double operator()(double x) const;               ///< of |x| [-]
  double reach() const { return distance.back(); } ///< [m]
  /// Integral of the share over x from minus to plus infinity [m].
  double integral() const;

private:
  std::vector<double> distance, share;
};
} // namespace fem
