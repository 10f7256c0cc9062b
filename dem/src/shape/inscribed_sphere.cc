#include <dem/shape/form.h>
#include <dem/shape/quadrature.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace dem
{
namespace
{
/// The distance to the nearest point with its edges rounded off,
/// -1/b log sum exp(-b |x_k - c|), and its derivatives by c.
struct SoftDistance
{
  double value = 0.;
  Vec3 gradient = Vec3::Zero();
  Mat3 second = Mat3::Zero();
};

double nearest_distance(const std::vector<Vec3> &points, const Vec3 &centre)
{
  double square = std::numeric_limits<double>::max();
  for (const Vec3 &point : points)
    square = std::min(square, (point - centre).squaredNorm());
  return std::sqrt(square);
}

SoftDistance soft_distance(const std::vector<Vec3> &points, const Vec3 &centre,
                           double sharpness)
{
  const double nearest = nearest_distance(points, centre);
  const double reach = nearest + 40. / sharpness; // exp(-40) counts for nothing
  SoftDistance soft;
  double sum = 0.;
  for (const Vec3 &point : points)
  {
    const Vec3 away = centre - point;
    if (away.squaredNorm() > reach * reach)
      continue;
    const double distance = away.norm();
    const Vec3 uphill = away / distance;
    const double share = std::exp(-sharpness * (distance - nearest));
    sum += share;
    soft.gradient += share * uphill;
    soft.second +=
        share * ((Mat3::Identity() - uphill * uphill.transpose()) / distance -
                 sharpness * uphill * uphill.transpose());
  }
  soft.gradient /= sum;
  soft.second =
      soft.second / sum + sharpness * soft.gradient * soft.gradient.transpose();
  soft.value = nearest - std::log(sum) / sharpness;
  return soft;
}

/// Uphill by damped Newton steps until they are short.
Vec3 ascend(const std::vector<Vec3> &points, Vec3 centre, double sharpness,
            double size)
{
  double damping = 1. / size;
  SoftDistance here = soft_distance(points, centre, sharpness);
  for (int step = 0; step < 100; ++step)
  {
    // the largest eigenvalue of `second` is at most 1 / distance
    const Mat3 matrix =
        (damping + 1. / here.value) * Mat3::Identity() - here.second;
    const Vec3 move = matrix.ldlt().solve(here.gradient);
    const SoftDistance there = soft_distance(points, centre + move, sharpness);
    if (there.value > here.value)
    {
      centre += move;
      here = there;
      damping *= 0.2;
    }
    else
      damping *= 5.;
    if (move.norm() < 1e-6 * size)
      break;
  }
  return centre;
}
} // namespace

InscribedSphere inscribed_sphere(std::span<const double> coefficients)
{
  static const SphereQuadrature rule = make_quadrature(120, 240);
  return inscribed_sphere(coefficients, rule);
}

InscribedSphere inscribed_sphere(std::span<const double> coefficients,
                                 const SphereQuadrature &rule)
{
  const std::vector<double> radii = node_radii(coefficients, rule);
  std::vector<Vec3> points;
  for (std::size_t k = 0; k < radii.size(); ++k)
    points.push_back(radii[k] * rule.direction[k]);
  const double size = *std::min_element(radii.begin(), radii.end());
  InscribedSphere sphere;
  // the rounding shrinks to 1e-4 of the radius
  for (double sharpness = 30.; sharpness < 1e5; sharpness *= 3.)
    sphere.centre = ascend(points, sphere.centre, sharpness / size, size);
  sphere.radius = nearest_distance(points, sphere.centre);
  return sphere;
}
} // namespace dem
