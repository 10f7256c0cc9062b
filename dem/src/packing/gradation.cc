#include <dem/packing/gradation.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace dem
{
namespace
{
double passing_at(const GradingCurve &curve, double diameter)
{
  const auto above =
      std::upper_bound(curve.diameter.begin(), curve.diameter.end(), diameter);
  if (above == curve.diameter.begin())
    return curve.passing.front();
  if (above == curve.diameter.end())
    return curve.passing.back();
  const auto k = static_cast<std::size_t>(above - curve.diameter.begin());
  const double share = std::log(diameter / curve.diameter[k - 1]) /
                       std::log(curve.diameter[k] / curve.diameter[k - 1]);
  return std::lerp(curve.passing[k - 1], curve.passing[k], share);
}
} // namespace

Quaternion Random::rotation()
{
  const double u = uniform(), v = 2. * std::numbers::pi * uniform(),
               w = 2. * std::numbers::pi * uniform();
  const double a = std::sqrt(1. - u), b = std::sqrt(u);
  return {b * std::cos(w), a * std::sin(v), a * std::cos(v), b * std::sin(w)};
}

std::vector<Body>
draw_stones(const GradingCurve &curve, double solid_volume,
            std::span<const std::shared_ptr<const Coefficients>> shapes,
            Random &random)
{
  constexpr int n_classes = 40;
  const double largest = curve.diameter.back(),
               ratio = largest / curve.diameter.front();
  std::vector<Body> stones;
  double owed = 0.;
  for (int c = 0; c < n_classes; ++c)
  {
    const double upper =
        largest * std::pow(ratio, -static_cast<double>(c) / n_classes);
    const double lower =
        largest * std::pow(ratio, -static_cast<double>(c + 1) / n_classes);
    owed +=
        solid_volume * (passing_at(curve, upper) - passing_at(curve, lower));
    while (true)
    {
      const double diameter = lower * std::pow(upper / lower, random.uniform());
      const Body stone =
          shapes.empty()
              ? make_sphere(0.5 * diameter)
              : make_body(shapes[random.below(shapes.size())], 0.5 * diameter);
      if (owed < 0.5 * stone.volume)
        break;
      owed -= stone.volume;
      stones.push_back(stone);
    }
  }
  std::stable_sort(stones.begin(), stones.end(),
                   [](const Body &a, const Body &b)
                   { return a.volume > b.volume; });
  return stones;
}
} // namespace dem
