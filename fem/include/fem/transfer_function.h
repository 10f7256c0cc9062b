#pragma once

#include <complex>
#include <span>
#include <vector>

namespace fem
{
/// A load and what it moves, sampled at the same times.
struct Response
{
  std::span<const double> time;   ///< ascending [s]
  std::span<const double> load;   ///< [N]
  std::span<const double> motion; ///< velocity, for one [m/s]
};

/// Finite Fourier integral int f exp(-i 2 pi f t) dt, exact for straight lines
/// between the samples (Filon 1928) [unit of f times s].
std::complex<double> fourier_integral(std::span<const double> time,
                                      std::span<const double> values,
                                      double frequency);

struct TransferPoint
{
  double frequency = 0.;      ///< [1/s]
  double load = 0.;           ///< |F(f)| [N s]
  std::complex<double> ratio; ///< V(f) / F(f) [m/(s N)]
};

/// Ratio of the integrals of motion and load at the frequencies 1 / T, 2 / T,
/// ... up to `highest` of a record of length T that begins and ends at rest
/// without load: then it is the transfer function of a linear body whatever the
/// load was. Frequencies at which the load has less than `floor` of its largest
/// integral say nothing and are left out. Throws std::invalid_argument on
/// columns that do not fit.
std::vector<TransferPoint> transfer_function(const Response &response,
                                             double highest,
                                             double floor = 0.02);
} // namespace fem
