#include <dem/packing/gradation.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

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

constexpr int n_classes = 40;

/// One of narrow classes of the curve.
struct SizeClass
{
  double lower = 0., upper = 0.; ///< diameters [m]
  double share = 0.;             ///< of the volume [-]
};

/// From the largest.
std::vector<SizeClass> classes_of(const GradingCurve &curve)
{
  const double largest = curve.diameter.back(),
               ratio = largest / curve.diameter.front();
  std::vector<SizeClass> classes;
  for (int c = 0; c < n_classes; ++c)
  {
    const auto bound = [&](int of)
    { return largest * std::pow(ratio, -static_cast<double>(of) / n_classes); };
    const double upper = bound(c), lower = bound(c + 1);
    classes.push_back(
        {lower, upper, passing_at(curve, upper) - passing_at(curve, lower)});
  }
  return classes;
}

/// Throws std::invalid_argument where so many would take all memory.
void require_drawable(const std::vector<SizeClass> &classes,
                      double solid_volume)
{
  constexpr double most = 1e7;
  double n_stones = 0.; // of the largest of each class
  for (const SizeClass &c : classes)
    n_stones +=
        solid_volume * c.share / (std::numbers::pi / 6. * std::pow(c.upper, 3));
  if (!(n_stones <= most))
    throw std::invalid_argument(
        "the gradation fills the volume with more than 10000000 stones: its "
        "diameters and the lengths of the case must be in m");
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
  const std::vector<SizeClass> classes = classes_of(curve);
  require_drawable(classes, solid_volume);
  std::vector<Body> stones;
  double owed = 0.;
  for (const auto &[lower, upper, share] : classes)
  {
    owed += solid_volume * share;
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
