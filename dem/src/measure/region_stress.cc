#include <dem/measure/region_stress.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

namespace dem
{
namespace
{
using Vec2 = Eigen::Vector2d;

/// Outward normal of the side from corner k on, in the plane.
Vec2 outward(const Prism &prism, std::size_t k)
{
  const Vec2 side =
      prism.corners[(k + 1) % prism.corners.size()] - prism.corners[k];
  return Vec2(side.y(), -side.x()).normalized();
}

double base_area(const std::vector<Vec2> &corners)
{
  double twice = 0.;
  for (std::size_t k = 0; k < corners.size(); ++k)
  {
    const Vec2 &p = corners[k], &q = corners[(k + 1) % corners.size()];
    twice += p.x() * q.y() - p.y() * q.x();
  }
  return 0.5 * twice;
}

/// Where two sides meet, each given by its normal and its distance from the
/// origin along it.
Vec2 meeting_point(const Vec2 &n, double d, const Vec2 &m, double e)
{
  const double cross = n.x() * m.y() - n.y() * m.x();
  return Vec2(d * m.y() - e * n.y(), e * n.x() - d * m.x()) / cross;
}

Vec3 branch_of(const ParticleSystem &particles, const PairContact &contact)
{
  return particles.branch(static_cast<std::size_t>(contact.a),
                          static_cast<std::size_t>(contact.b));
}
} // namespace

double Prism::volume() const
{
  return base_area(corners) * (high - low);
}

Prism prism_of(const Vec3 &lower, const Vec3 &upper)
{
  return {{lower.head<2>(),
           {upper.x(), lower.y()},
           upper.head<2>(),
           {lower.x(), upper.y()}},
          lower.z(),
          upper.z()};
}

Prism prism_of_cylinder(const Vec2 &centre, double radius, double low,
                        double high)
{
  constexpr int n = 72;
  const double turn = 2. * std::numbers::pi / n;
  const double reach = radius * std::sqrt(turn / std::sin(turn));
  Prism prism{{}, low, high};
  for (int k = 0; k < n; ++k)
    prism.corners.push_back(
        centre + reach * Vec2(std::cos(k * turn), std::sin(k * turn)));
  return prism;
}

std::vector<Vec2> corners_through(std::vector<Vec2> points)
{
  Vec2 middle = Vec2::Zero();
  for (const Vec2 &point : points)
    middle += point / static_cast<double>(points.size());
  const auto angle = [&](const Vec2 &point)
  { return std::atan2(point.y() - middle.y(), point.x() - middle.x()); };
  std::ranges::sort(points, {}, angle);
  std::vector<Vec2> corners;
  const std::size_t n = points.size();
  for (std::size_t k = 0; k < n; ++k)
  {
    const Vec2 before = points[k] - points[(k + n - 1) % n],
               after = points[(k + 1) % n] - points[k];
    const double turn = before.x() * after.y() - before.y() * after.x();
    if (turn > 1e-9 * before.norm() * after.norm())
      corners.push_back(points[k]);
  }
  return corners;
}

Prism without_skin(const Prism &prism, double skin)
{
  Prism inner{{}, prism.low + skin, prism.high - skin};
  const std::size_t n = prism.corners.size();
  for (std::size_t k = 0; k < n; ++k)
  {
    const std::size_t before = (k + n - 1) % n;
    const Vec2 one = outward(prism, before), other = outward(prism, k);
    inner.corners.push_back(meeting_point(one, one.dot(prism.corners[k]) - skin,
                                          other,
                                          other.dot(prism.corners[k]) - skin));
  }
  // A side that was moved past the opposite one turns round.
  for (std::size_t k = 0; k < n; ++k)
    if (outward(inner, k).dot(outward(prism, k)) < 0.)
      throw std::invalid_argument("the skin takes up the whole specimen");
  if (inner.high <= inner.low)
    throw std::invalid_argument("the skin takes up the whole specimen");
  return inner;
}

std::optional<std::pair<double, double>>
part_inside(const Prism &prism, const Vec3 &from, const Vec3 &to)
{
  double first = 0., last = 1.;
  // Behind every face n.x <= d.
  const auto cut = [&](double height_from, double height_to)
  {
    if (height_from > 0. && height_to > 0.)
      last = -1.;
    else if (height_from > 0.)
      first = std::max(first, height_from / (height_from - height_to));
    else if (height_to > 0.)
      last = std::min(last, height_from / (height_from - height_to));
  };
  cut(from.z() - prism.high, to.z() - prism.high);
  cut(prism.low - from.z(), prism.low - to.z());
  for (std::size_t k = 0; k < prism.corners.size(); ++k)
  {
    const Vec2 n = outward(prism, k);
    cut(n.dot(from.head<2>() - prism.corners[k]),
        n.dot(to.head<2>() - prism.corners[k]));
  }
  if (first >= last)
    return std::nullopt;
  return std::pair(first, last);
}

Mat3 contact_virial(const ParticleSystem &particles, const Network &network)
{
  Mat3 sum = Mat3::Zero();
  const auto at = [&](std::int32_t particle) -> const Vec3 &
  { return particles.position(static_cast<std::size_t>(particle)); };
  for (const PairContact &contact : network.pairs)
    sum -= contact.force * branch_of(particles, contact).transpose();
  for (const WallContact &contact : network.walls)
    sum -= contact.force * (contact.point - at(contact.particle)).transpose() +
           contact.spread;
  return sum;
}

Mat3 mean_stress(const Prism &prism, const ParticleSystem &particles,
                 const Network &network)
{
  Mat3 sum = Mat3::Zero();
  const auto add = [&](std::int32_t a, const Vec3 &to, const Vec3 &force)
  {
    const Vec3 &from = particles.position(static_cast<std::size_t>(a));
    if (const auto part = part_inside(prism, from, to))
      sum -= force * ((part->second - part->first) * (to - from)).transpose();
  };
  for (const PairContact &contact : network.pairs)
    add(contact.a,
        particles.position(static_cast<std::size_t>(contact.a)) +
            branch_of(particles, contact),
        contact.force);
  for (const WallContact &contact : network.walls)
    add(contact.particle, contact.point, contact.force);
  return 0.5 * (sum + sum.transpose()) / prism.volume();
}
} // namespace dem
