#include <dem/shape/quadrature.h>
#include <dem/shape/radius_map.h>

#include <algorithm>
#include <array>
#include <functional>
#include <utility>

namespace dem
{
namespace
{
/// The nodes as a rule to sum series over; its weights are never read.
const SphereQuadrature &node_rule()
{
  static const SphereQuadrature rule = []
  {
    constexpr DirectionGrid grid = RadiusMap::nodes;
    SphereQuadrature made = make_quadrature(grid.n_polar, grid.n_azimuth);
    for (int i = 0; i < grid.n_polar; ++i)
      made.ring_cosine[static_cast<std::size_t>(i)] = grid.direction(i, 0).z();
    for (int node = 0; node < grid.size(); ++node)
      made.direction[static_cast<std::size_t>(node)] =
          grid.direction(node / grid.n_azimuth, node % grid.n_azimuth);
    return made;
  }();
  return rule;
}

std::vector<Eigen::Vector3f> directions_of(const DirectionGrid &grid)
{
  std::vector<Eigen::Vector3f> all;
  for (int node = 0; node < grid.size(); ++node)
    all.push_back(grid.direction(node / grid.n_azimuth, node % grid.n_azimuth)
                      .cast<float>());
  return all;
}

const std::vector<Eigen::Vector3f> &node_directions()
{
  static const std::vector<Eigen::Vector3f> directions =
      directions_of(RadiusMap::nodes);
  return directions;
}

const std::vector<Eigen::Vector3f> &side_directions()
{
  static const std::vector<Eigen::Vector3f> directions =
      directions_of(RadiusMap::sides);
  return directions;
}

/// Every second node of every second ring, as many as there are sides, and as
/// far from each other.
constexpr DirectionGrid coarse = RadiusMap::sides;
static_assert(2 * coarse.n_polar == RadiusMap::nodes.n_polar &&
              2 * coarse.n_azimuth == RadiusMap::nodes.n_azimuth);

/// Node of a place in rings of coarse nodes that go round twice.
constexpr int node_at(int place)
{
  return 2 * (place / (2 * coarse.n_azimuth)) * RadiusMap::nodes.n_azimuth +
         2 * (place % coarse.n_azimuth);
}

/// A coarse node seen from a side in column 0 of its ring; that of column k is
/// at place + k.
struct Sight
{
  int place = 0;
  float cosine = 0.f; ///< of the angle between them, not less
};

/// What the sides of each ring see, the nearest first.
const std::vector<std::vector<Sight>> &sights()
{
  static const std::vector<std::vector<Sight>> by_ring = []
  {
    std::vector<std::vector<Sight>> all(
        static_cast<std::size_t>(coarse.n_polar));
    for (int ring = 0; ring < coarse.n_polar; ++ring)
    {
      std::vector<Sight> &seen = all[static_cast<std::size_t>(ring)];
      const Vec3 side = RadiusMap::sides.direction(ring, 0);
      for (int i = 0; i < coarse.n_polar; ++i)
        for (int k = 0; k < coarse.n_azimuth; ++k)
        {
          const Vec3 node = RadiusMap::nodes.direction(2 * i, 2 * k);
          seen.push_back({2 * i * coarse.n_azimuth + k,
                          static_cast<float>(node.dot(side)) + 1e-5f});
        }
      std::ranges::sort(seen, std::ranges::greater{}, &Sight::cosine);
    }
    return all;
  }();
  return by_ring;
}

/// The nodes beside each coarse one, and itself first.
using Neighbours = std::array<int, 9>;

Neighbours neighbours_of(int node)
{
  constexpr DirectionGrid grid = RadiusMap::nodes;
  Neighbours around{node};
  std::size_t n = 1;
  for (int down = -1; down <= 1; ++down)
    for (int right = -1; right <= 1; ++right)
      if (down != 0 || right != 0)
        around[n++] = grid.neighbour(node / grid.n_azimuth,
                                     node % grid.n_azimuth, down, right);
  return around;
}

const std::vector<Neighbours> &neighbours()
{
  static const std::vector<Neighbours> by_place = []
  {
    std::vector<Neighbours> all;
    for (int place = 0; place < 2 * coarse.size(); ++place)
      all.push_back(neighbours_of(node_at(place)));
    return all;
  }();
  return by_place;
}

/// Finds the nodes that are highest along the sides. The hull of a stone that
/// has just broken is measured while others wait: only nodes near enough to a
/// side are looked at.
class Summits
{
public:
  explicit Summits(const RadiusMap &map)
  {
    for (int node = 0; node < RadiusMap::nodes.size(); ++node)
      points.push_back(map.point(node));
    for (int place = 0; place < 2 * coarse.size(); ++place)
    {
      rings.push_back(points[static_cast<std::size_t>(node_at(place))]);
      farthest = std::max(farthest, rings.back().norm());
    }
  }

  /// The highest of the coarse nodes, or one beside it if that is higher.
  int along(int side) const
  {
    const Eigen::Vector3f &direction =
        side_directions()[static_cast<std::size_t>(side)];
    const int ring = side / coarse.n_azimuth, column = side % coarse.n_azimuth;
    float highest = 0.f; // the origin is inside
    int top = 0;
    for (const Sight &seen : sights()[static_cast<std::size_t>(ring)])
    {
      if (seen.cosine * farthest < highest)
        break;
      const int place = seen.place + column;
      const float height =
          rings[static_cast<std::size_t>(place)].dot(direction);
      if (height > highest)
      {
        highest = height;
        top = place;
      }
    }
    const Neighbours &around = neighbours()[static_cast<std::size_t>(top)];
    return *std::ranges::max_element(
        around, {},
        [&](int node)
        { return points[static_cast<std::size_t>(node)].dot(direction); });
  }

private:
  std::vector<Eigen::Vector3f> points; ///< all nodes
  std::vector<Eigen::Vector3f> rings;  ///< the coarse ones, each ring twice
  float farthest = 0.f;                ///< of those from the origin
};

std::vector<double> sampled_radii(const Coefficients *series)
{
  return series ? node_radii(*series, node_rule())
                : std::vector<double>(
                      static_cast<std::size_t>(RadiusMap::nodes.size()), 1.);
}
} // namespace

RadiusMap::RadiusMap(std::shared_ptr<const Coefficients> sampled)
    : series(std::move(sampled))
{
  radius = GridValues(nodes, sampled_radii(series.get()));
  measure_hull();
}

Eigen::Vector3f RadiusMap::point(int node) const
{
  const auto r = static_cast<float>(
      radius.at(node / nodes.n_azimuth, node % nodes.n_azimuth));
  return r * node_directions()[static_cast<std::size_t>(node)];
}

void RadiusMap::measure_hull()
{
  const Summits summits(*this);
  std::vector<double> heights;
  double largest = 0.;
  for (int side = 0; side < sides.size(); ++side)
  {
    summit.push_back(summits.along(side));
    const Eigen::Vector3f top = point(summit.back());
    heights.push_back(
        top.dot(side_directions()[static_cast<std::size_t>(side)]));
    largest = std::max(largest, double{top.norm()});
  }
  hull = GridValues(sides, heights);
  // Between two sides 0.13 rad apart a point rises by (0.13 / 2)^2 / 2 in
  // either direction, and corners between nodes by about as much.
  hull_slack = 0.01 * largest;
}

RadiusMap::Height RadiusMap::height(const Vec3 &direction) const
{
  const DirectionGrid::Place at = sides.locate(direction);
  const double upper = (1. - at.right) * hull.at(at.ring, at.column) +
                       at.right * hull.at(at.ring, at.column + 1);
  const double lower = (1. - at.right) * hull.at(at.ring + 1, at.column) +
                       at.right * hull.at(at.ring + 1, at.column + 1);
  const int ring = std::clamp(at.ring + (at.down > 0.5), 0, sides.n_polar - 1);
  const int side =
      ring * sides.n_azimuth + (at.column + (at.right > 0.5)) % sides.n_azimuth;
  return {(1. - at.down) * upper + at.down * lower + hull_slack,
          summit[static_cast<std::size_t>(side)]};
}
} // namespace dem
