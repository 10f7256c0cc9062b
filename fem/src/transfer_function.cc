#include <fem/transfer_function.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

namespace fem
{
namespace
{
using Complex = std::complex<double>;

/// Integrals over one interval of exp(-i z s) and s exp(-i z s), 0 < s < 1.
struct Moments
{
  Complex zeroth, first;
};

Moments moments(double z)
{
  if (std::abs(z) < 1e-3) // series to third order
    return {{1. - z * z / 6., -z / 2. + z * z * z / 24.},
            {0.5 - z * z / 8., -z / 3. + z * z * z / 30.}};
  const Complex i(0., 1.), end = std::exp(-i * z);
  const Complex zeroth = i * (end - 1.) / z;
  return {zeroth, i * (end - zeroth) / z};
}
} // namespace

Complex fourier_integral(std::span<const double> time,
                         std::span<const double> values, double frequency)
{
  const double omega = 2. * std::numbers::pi * frequency;
  Complex sum = 0.;
  for (std::size_t k = 1; k < time.size(); ++k)
  {
    const double step = time[k] - time[k - 1];
    const Moments m = moments(omega * step);
    sum += std::polar(step, -omega * (time[k - 1] - time[0])) *
           (values[k - 1] * (m.zeroth - m.first) + values[k] * m.first);
  }
  return sum;
}

std::vector<TransferPoint> transfer_function(const Response &response,
                                             double highest, double floor)
{
  const std::size_t n = response.time.size();
  if (response.load.size() != n || response.motion.size() != n)
    throw std::invalid_argument(
        "transfer function: columns must be equally long");
  if (n < 3)
    return {};
  const double length = response.time.back() - response.time.front();
  std::vector<TransferPoint> points;
  double largest = 0.;
  for (int k = 1; k <= highest * length; ++k)
  {
    TransferPoint point;
    point.frequency = k / length;
    const Complex load =
        fourier_integral(response.time, response.load, point.frequency);
    point.load = std::abs(load);
    largest = std::max(largest, point.load);
    if (point.load > 0.)
      point.ratio =
          fourier_integral(response.time, response.motion, point.frequency) /
          load;
    points.push_back(point);
  }
  std::erase_if(points, [&](const TransferPoint &point)
                { return !(point.load > floor * largest); });
  return points;
}
} // namespace fem
