#include <dem/boundary/facet_surface.h>

#include <algorithm>
#include <cstddef>

namespace dem
{
namespace
{
/// A face whose (height / size)^2 is below this is taken as its three sides:
/// the region test loses (distance / height)^2 1e-16 of the weights [-].
constexpr double sliver = 1e-12;

NearestPoint at_corner(const std::array<Vec3, 3> &corner, std::int32_t which)
{
  NearestPoint result;
  result.feature = Feature::vertex;
  result.which = which;
  result.weight[static_cast<std::size_t>(which)] = 1.;
  result.point = corner[static_cast<std::size_t>(which)];
  return result;
}

/// Point of side `which` at the fraction t from its first corner.
NearestPoint at_side(const std::array<Vec3, 3> &corner, std::int32_t which,
                     double t)
{
  const std::size_t from = static_cast<std::size_t>(which);
  const std::size_t to = (from + 1) % 3;
  NearestPoint result;
  result.feature = Feature::edge;
  result.which = which;
  result.weight[from] = 1. - t;
  result.weight[to] = t;
  result.point = corner[from] + t * (corner[to] - corner[from]);
  return result;
}

NearestPoint nearest_on_side(const Vec3 &x, const std::array<Vec3, 3> &corner,
                             std::int32_t which)
{
  const std::size_t from = static_cast<std::size_t>(which);
  const std::int32_t to = (which + 1) % 3;
  const Vec3 side = corner[static_cast<std::size_t>(to)] - corner[from];
  const double along = (x - corner[from]).dot(side);
  const double square = side.squaredNorm();
  if (along <= 0.)
    return at_corner(corner, which);
  if (along >= square)
    return at_corner(corner, to);
  return at_side(corner, which, along / square);
}

/// A triangle without area is its three sides.
NearestPoint on_sliver(const Vec3 &x, const std::array<Vec3, 3> &corner)
{
  NearestPoint best = nearest_on_side(x, corner, 0);
  for (const std::int32_t which : {1, 2})
  {
    const NearestPoint other = nearest_on_side(x, corner, which);
    if ((other.point - x).squaredNorm() < (best.point - x).squaredNorm())
      best = other;
  }
  return best;
}

} // namespace

// Region test of Ericson (2005), Real-Time Collision Detection, 5.1.5.
NearestPoint nearest_point(const Vec3 &x, const std::array<Vec3, 3> &corner)
{
  const Vec3 ab = corner[1] - corner[0], ac = corner[2] - corner[0];
  const Vec3 ap = x - corner[0], bp = x - corner[1], cp = x - corner[2];
  const double d1 = ab.dot(ap), d2 = ac.dot(ap);
  if (d1 <= 0. && d2 <= 0.)
    return at_corner(corner, 0);
  const double d3 = ab.dot(bp), d4 = ac.dot(bp);
  if (d3 >= 0. && d4 <= d3)
    return at_corner(corner, 1);
  const double d5 = ab.dot(cp), d6 = ac.dot(cp);
  if (d6 >= 0. && d5 <= d6)
    return at_corner(corner, 2);

  // A side of no length is passed over: one of the other two will do.
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0. && d1 >= 0. && d3 <= 0. && d1 > d3)
    return at_side(corner, 0, d1 / (d1 - d3));
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0. && d4 >= d3 && d5 >= d6 && (d4 - d3) + (d5 - d6) > 0.)
    return at_side(corner, 1, (d4 - d3) / ((d4 - d3) + (d5 - d6)));
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0. && d2 >= 0. && d6 <= 0. && d2 > d6)
    return at_side(corner, 2, d6 / (d6 - d2));

  const double side = std::max(ab.squaredNorm(), ac.squaredNorm());
  const double sum = va + vb + vc; // |ab x ac|^2
  if (!(sum > sliver * side * std::max(side, ap.squaredNorm())))
    return on_sliver(x, corner);
  NearestPoint result;
  result.weight = {1. - vb / sum - vc / sum, vb / sum, vc / sum};
  result.point = corner[0] + result.weight[1] * ab + result.weight[2] * ac;
  return result;
}
} // namespace dem
