#include "study/estimate.h"

#include "report/text.h"

#include <array>
#include <cmath>
#include <numeric>

namespace spall
{
double student_95(std::size_t n)
{
  constexpr std::array<double, 11> small = {
      std::numeric_limits<double>::infinity(),
      12.7062,
      4.3027,
      3.1824,
      2.7764,
      2.5706,
      2.4469,
      2.3646,
      2.3060,
      2.2622,
      2.2281};
  if (n < small.size())
    return small[n];
  // Expansion about the normal distribution (Abramowitz and Stegun 26.7.5).
  const double x = 1.959964, m = static_cast<double>(n), x3 = x * x * x,
               x5 = x3 * x * x, x7 = x5 * x * x;
  return x + (x3 + x) / (4. * m) +
         (5. * x5 + 16. * x3 + 3. * x) / (96. * m * m) +
         (3. * x7 + 19. * x5 + 17. * x3 - 15. * x) / (384. * m * m * m);
}

namespace
{
double mean_of(std::span<const double> samples)
{
  return std::accumulate(samples.begin(), samples.end(), 0.) /
         static_cast<double>(samples.size());
}
} // namespace

double standard_deviation(std::span<const double> samples)
{
  if (samples.size() < 2)
    return 0.;
  const double mean = mean_of(samples);
  double sum = 0.;
  for (const double sample : samples)
    sum += (sample - mean) * (sample - mean);
  return std::sqrt(sum / static_cast<double>(samples.size() - 1));
}

std::string in_words(const Estimate &e, double scale)
{
  std::string text = format(e.mean, 3);
  if (std::isfinite(e.half_width))
    text += " ± " + format(e.half_width, 2);
  if (scale > 0.)
    text += " (" + format(100. * e.mean / scale, 3) + " %)";
  return text;
}

Estimate estimate_of(std::span<const double> samples)
{
  Estimate estimate;
  estimate.n = samples.size();
  if (estimate.n == 0)
    return estimate;
  estimate.mean = mean_of(samples);
  if (estimate.n > 1)
    estimate.half_width = student_95(estimate.n - 1) *
                          standard_deviation(samples) /
                          std::sqrt(static_cast<double>(estimate.n));
  return estimate;
}
} // namespace spall
