#include <dem/contact/paraboloid.h>

namespace dem
{
Mat3 surface_axes(const Vec3 &normal)
{
  const double sign = normal.z() < 0. ? -1. : 1.;
  const double a = -1. / (sign + normal.z()), b = normal.x() * normal.y() * a;
  Mat3 axes;
  axes.col(0) = Vec3(1. + sign * normal.x() * normal.x() * a, sign * b,
                     -sign * normal.x());
  axes.col(1) = Vec3(b, sign + normal.y() * normal.y() * a, -normal.y());
  axes.col(2) = axes.col(0).cross(axes.col(1));
  return axes;
}

SurfacePoint Paraboloid::at(const Vec3 &w) const
{
  const Vec3 turn = vertex.shape_operator * w;
  SurfacePoint point;
  point.position = vertex.position + w - 0.5 * w.dot(turn) * vertex.normal;
  point.normal = (vertex.normal + turn).normalized();
  const Mat3 across =
      Mat3::Identity() - point.normal * point.normal.transpose();
  point.shape_operator = across * vertex.shape_operator * across;
  return point;
}

Vec3 Paraboloid::offset_towards(const Vec3 &direction) const
{
  const Vec3 &n = vertex.normal;
  const double along = direction.dot(n);
  Vec3 w = Vec3::Zero();
  // Where the ray meets the tangent plane, lowered to the paraboloid: the
  // error of each round is of the next power of w.
  for (int round = 0; round < 4; ++round)
  {
    const double fall = 0.5 * w.dot(vertex.shape_operator * w);
    w = (height() - fall) / along * direction - vertex.position;
    w -= w.dot(n) * n;
  }
  return w;
}
} // namespace dem
