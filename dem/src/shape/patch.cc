#include <dem/shape/patch.h>

#include <algorithm>
#include <cmath>

namespace dem
{
namespace
{
struct Frame
{
  Vec3 first, second;
};

/// Two unit tangents of the unit sphere; the axis least along s has no
/// trouble anywhere.
Frame tangent_frame(const Vec3 &s)
{
  Eigen::Index axis = 0;
  s.cwiseAbs().minCoeff(&axis);
  const Vec3 first = s.cross(Vec3::Unit(axis)).normalized();
  return {first, s.cross(first)};
}

/// Unit vector in the plane along the principal direction of the larger
/// eigenvalue of [[a, b], [b, c]]: of its two forms the one without
/// cancellation. Square roots only: same digits on every machine.
Eigen::Vector2d larger_direction(double a, double b, double c)
{
  const double half = 0.5 * (a - c);
  const double far = std::abs(half) + std::sqrt(half * half + b * b);
  const double length = std::sqrt(far * far + b * b);
  if (!(length > 0.)) // equal eigenvalues: any direction
    return {1., 0.};
  return half >= 0. ? Eigen::Vector2d(far, b) / length
                    : Eigen::Vector2d(b, far) / length;
}
} // namespace

// I = r^2 1 + p p^T with p = grad r in the frame. In the basis along p and
// across it I is diagonal, (W^2, r^2), so that I^(-1/2) II I^(-1/2) is
// symmetric and written down at once.
PrincipalCurvatures principal_curvatures(const RadialExpansion &expansion)
{
  const Vec3 &s = expansion.direction, &g = expansion.gradient;
  const double r = expansion.radius, slope = g.norm();
  const double w = std::sqrt(r * r + slope * slope);
  Frame frame = tangent_frame(s);
  // Below, any frame is principal of I to (g / r)^2, and the direction of g
  // may be round-off.
  if (slope > 1e-7 * std::abs(r))
    frame = {g / slope, s.cross(g) / slope};

  const Mat3 &h = expansion.hessian;
  const double h11 = frame.first.dot(h * frame.first);
  const double h12 = frame.first.dot(h * frame.second);
  const double h22 = frame.second.dot(h * frame.second);
  const double a = (r * r + 2. * slope * slope - r * h11) / (w * w * w);
  const double b = -h12 / (w * w);
  const double c = (r * r - r * h22) / (w * r * r);

  const double mean = 0.5 * (a + c);
  const double half_gap = std::sqrt(0.25 * (a - c) * (a - c) + b * b);
  const Eigen::Vector2d v = larger_direction(a, b, c);
  // back through I^(-1/2), then onto the surface: x_1 = slope s + r t_1
  const double along = v[0] / w, across = v[1] / r;
  PrincipalCurvatures result;
  result.maximum = mean + half_gap;
  result.minimum = mean - half_gap;
  result.max_direction =
      (along * (slope * s + r * frame.first) + across * r * frame.second)
          .normalized();
  result.normal = (r * s - g) / w;
  return result;
}
} // namespace dem
