#include <dem/packing/gradation.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <utility>

namespace dem
{
namespace
{
/// Two neighbouring sieves with mass between them.
struct SieveInterval
{
  double lower = 0., upper = 0.;                 ///< diameters [m]
  double lower_passing = 0., upper_passing = 0.; ///< [-]

  double width() const { return std::log(upper / lower); } ///< in ln(d) [-]

  double passing_at(double diameter) const
  {
    const double share = std::log(diameter / lower) / width();
    return std::lerp(lower_passing, upper_passing, std::clamp(share, 0., 1.));
  }
};

/// From the largest; without those where the curve is flat.
std::vector<SieveInterval> filled_intervals(const GradingCurve &curve)
{
  std::vector<SieveInterval> intervals;
  for (std::size_t k = curve.diameter.size(); k-- > 1;)
    if (curve.passing[k] > curve.passing[k - 1])
      intervals.push_back({curve.diameter[k - 1], curve.diameter[k],
                           curve.passing[k - 1], curve.passing[k]});
  return intervals;
}

// Within a class of width w the diameters are uniform in ln(d): its lower half
// holds 1/2 - 3 w/8 of its mass, at most 2.3 % of the class too little.
constexpr double widest_class = 0.06;  ///< in ln(d) [-]
constexpr double fewest_classes = 40.; ///< of an interval

/// One of narrow classes of the curve.
struct SizeClass
{
  double lower = 0., upper = 0.; ///< diameters [m]
  double share = 0.;             ///< of the volume [-]
};

/// From the largest.
std::vector<SizeClass> classes_of(const SieveInterval &interval)
{
  const double ratio = interval.upper / interval.lower;
  const double n =
      std::max(fewest_classes, std::ceil(interval.width() / widest_class));
  std::vector<SizeClass> classes;
  for (double c = 0.; c < n; ++c)
  {
    const double upper = interval.upper * std::pow(ratio, -c / n),
                 lower = interval.upper * std::pow(ratio, -(c + 1.) / n);
    classes.push_back(
        {lower, upper,
         interval.passing_at(upper) - interval.passing_at(lower)});
  }
  return classes;
}

double sphere_volume(double diameter)
{
  return std::numbers::pi / 6. * std::pow(diameter, 3);
}

using Shapes = std::span<const std::shared_ptr<const Coefficients>>;

/// The shapes as they are stored, measured once. Empty: spheres.
std::vector<ParticleShape> measured_shapes(Shapes shapes)
{
  std::vector<ParticleShape> bodies;
  for (const auto &shape : shapes)
  {
    ParticleShape stored;
    stored.series = shape;
    bodies.push_back(make_shape(shape, mean_radius(stored)));
  }
  return bodies;
}

/// Largest volume of these shapes over that of the sphere of their size [-].
double largest_volume_ratio(const std::vector<ParticleShape> &shapes)
{
  double ratio = shapes.empty() ? 1. : 0.;
  for (const ParticleShape &shape : shapes)
    ratio =
        std::max(ratio, shape.volume / sphere_volume(2. * mean_radius(shape)));
  return ratio;
}

/// Throws std::invalid_argument where so many would take all memory.
void require_drawable(const std::vector<SieveInterval> &intervals,
                      double solid_volume)
{
  constexpr double most = 1e7;
  double n_particles = 0.; // of the largest of each class
  for (const SieveInterval &interval : intervals)
    for (const SizeClass &c : classes_of(interval))
      n_particles += solid_volume * c.share / sphere_volume(c.upper);
  if (!(n_particles <= most))
    throw std::invalid_argument(
        "the gradation fills the volume with more than 10000000 particles: its "
        "diameters and the lengths of the case must be in m");
}

/// Particles of one gradation, class by class.
class Drawing
{
public:
  Drawing(double volume, Shapes choice, Random &source)
      : solid_volume(volume), shapes(measured_shapes(choice)), random(source),
        volume_ratio(largest_volume_ratio(shapes))
  {
  }

  void fill(const SieveInterval &interval)
  {
    const double most = 0.5 * volume_ratio * sphere_volume(interval.upper);
    owed = std::clamp(owed, -most, most);
    for (const SizeClass &c : classes_of(interval))
      fill(c, interval);
  }

  std::vector<ParticleShape> take() { return std::move(particles); }

private:
  void fill(const SizeClass &c, const SieveInterval &interval)
  {
    owed += solid_volume * c.share;
    while (true)
    {
      // Round-off must not cross a sieve.
      const double diameter =
          std::clamp(c.lower * std::pow(c.upper / c.lower, random.uniform()),
                     interval.lower, interval.upper);
      const ParticleShape particle =
          shapes.empty()
              ? make_sphere(0.5 * diameter)
              : resized(shapes[random.below(shapes.size())], 0.5 * diameter);
      if (owed < 0.5 * particle.volume)
        break;
      owed -= particle.volume;
      particles.push_back(particle);
    }
  }

  double solid_volume = 0.; ///< [m^3]
  std::vector<ParticleShape> shapes;
  Random &random;
  double volume_ratio = 1.; ///< of the most voluminous shape [-]
  double owed = 0.;         ///< required so far less what was drawn [m^3]
  std::vector<ParticleShape> particles;
};
} // namespace

Quaternion Random::rotation()
{
  const double u = uniform(), v = 2. * std::numbers::pi * uniform(),
               w = 2. * std::numbers::pi * uniform();
  const double a = std::sqrt(1. - u), b = std::sqrt(u);
  return {b * std::cos(w), a * std::sin(v), a * std::cos(v), b * std::sin(w)};
}

std::vector<ParticleShape> draw_particles(const GradingCurve &curve,
                                          double solid_volume, Shapes shapes,
                                          Random &random)
{
  const std::vector<SieveInterval> intervals = filled_intervals(curve);
  if (intervals.empty())
    throw std::invalid_argument("the gradation holds no mass");
  require_drawable(intervals, solid_volume);
  Drawing drawing(solid_volume, shapes, random);
  for (const SieveInterval &interval : intervals)
    drawing.fill(interval);
  std::vector<ParticleShape> particles = drawing.take();
  std::stable_sort(particles.begin(), particles.end(),
                   [](const ParticleShape &a, const ParticleShape &b)
                   { return a.volume > b.volume; });
  return particles;
}
} // namespace dem
