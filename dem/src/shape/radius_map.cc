#include <dem/shape/quadrature.h>
#include <dem/shape/radius_bounds.h>
#include <dem/shape/radius_map.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

namespace dem
{
namespace
{
constexpr DirectionGrid grid = RadiusMap::nodes;

/// The nodes as a rule to sum series over; its weights are never read.
const SphereQuadrature &node_rule()
{
  static const SphereQuadrature rule = []
  {
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

std::vector<Eigen::Vector3f> directions_of(const DirectionGrid &over)
{
  std::vector<Eigen::Vector3f> all;
  for (int node = 0; node < over.size(); ++node)
    all.push_back(over.direction(node / over.n_azimuth, node % over.n_azimuth)
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

constexpr int n_blocks = RadiusMap::blocks.size();
constexpr int block_nodes = RadiusMap::block_side * RadiusMap::block_side;
static_assert(n_blocks * block_nodes == grid.size());

/// The nodes of every block, one block after the other.
const std::vector<int> &nodes_by_block()
{
  static const std::vector<int> all = []
  {
    std::vector<int> by_block;
    for (int block = 0; block < n_blocks; ++block)
      for (int down = 0; down < RadiusMap::block_side; ++down)
        for (int right = 0; right < RadiusMap::block_side; ++right)
          by_block.push_back(RadiusMap::first_node(block) +
                             down * grid.n_azimuth + right);
    return by_block;
  }();
  return all;
}

/// Finds the nodes that are highest along the sides. The hull of a particle
/// that has just broken is measured while others wait: only blocks of nodes
/// that reach high enough are checked.
class Summits
{
public:
  explicit Summits(const RadiusMap &map)
  {
    for (const int node : nodes_by_block())
      points.push_back(map.point(node));
    for (int block = 0; block < n_blocks; ++block)
    {
      const Eigen::Vector3f &first =
          points[static_cast<std::size_t>(block * block_nodes)];
      x[static_cast<std::size_t>(block)] = first.x();
      y[static_cast<std::size_t>(block)] = first.y();
      z[static_cast<std::size_t>(block)] = first.z();
      reach[static_cast<std::size_t>(block)] =
          static_cast<float>(map.block_reach(block));
    }
  }

  /// The highest node; the one of the last side is the first guess.
  int along(int side)
  {
    const Eigen::Vector3f &direction =
        side_directions()[static_cast<std::size_t>(side)];
    float highest = points[last].dot(direction);
    std::array<float, std::size_t(n_blocks)> bound;
    for (std::size_t block = 0; block < bound.size(); ++block)
      bound[block] = x[block] * direction.x() + y[block] * direction.y() +
                     z[block] * direction.z() + reach[block];
    for (std::size_t block = 0; block < bound.size(); ++block)
    {
      if (bound[block] < highest)
        continue;
      const std::size_t first = block * std::size_t(block_nodes);
      for (std::size_t k = first; k < first + std::size_t(block_nodes); ++k)
        if (const float height = points[k].dot(direction); height > highest)
        {
          highest = height;
          last = k;
        }
    }
    return nodes_by_block()[last];
  }

private:
  using Column = std::array<float, std::size_t(n_blocks)>;

  std::vector<Eigen::Vector3f> points; ///< all nodes, block by block
  Column x, y, z, reach;               ///< of the first node of each block
  std::size_t last = 0;
};

std::vector<double> sampled_radii(const Coefficients *series)
{
  return series ? node_radii(*series, node_rule())
                : std::vector<double>(
                      static_cast<std::size_t>(RadiusMap::nodes.size()), 1.);
}

/// Of nodes this far apart no direction is farther than half a diagonal: the
/// square of that, halved [rad^2].
constexpr double half_square = 0.25 * (std::numbers::pi / grid.n_polar) *
                               (std::numbers::pi / grid.n_polar);
static_assert(grid.n_azimuth == 2 * grid.n_polar);

/// Largest |x''| of x = r(s) s along great circles, (r'' - r) s + 2 r' t, where
/// no node is farther from the origin than `farthest`.
double largest_second_derivative(const Coefficients &series, double farthest)
{
  const DerivativeBounds most = derivative_bounds(series);
  const double largest = farthest + half_square * most.second;
  return std::hypot(most.second + largest, 2. * most.first);
}
} // namespace

RadiusMap::RadiusMap(std::shared_ptr<const Coefficients> sampled)
    : series(std::move(sampled))
{
  radius = GridValues(nodes, sampled_radii(series.get()));
  measure_nodes();
  measure_hull();
}

Eigen::Vector3f RadiusMap::point(int node) const
{
  const auto r = static_cast<float>(
      radius.at(node / nodes.n_azimuth, node % nodes.n_azimuth));
  return r * node_directions()[static_cast<std::size_t>(node)];
}

void RadiusMap::measure_nodes()
{
  const std::vector<int> &order = nodes_by_block();
  std::vector<Eigen::Vector3f> points;
  for (int node = 0; node < nodes.size(); ++node)
  {
    points.push_back(point(node));
    farthest = std::max(farthest, double{points.back().norm()});
  }
  const auto at = [&points](int node) -> const Eigen::Vector3f &
  { return points[static_cast<std::size_t>(node)]; };
  reach.assign(static_cast<std::size_t>(n_blocks), 0.f);
  float diagonal = 0.f;
  for (int k = 0; k < nodes.size(); ++k)
  {
    const int node = order[static_cast<std::size_t>(k)],
              block = k / block_nodes, ring = node / nodes.n_azimuth;
    float &own = reach[static_cast<std::size_t>(block)];
    own = std::max(own,
                   (1.f + 1e-5f) * (at(node) - at(first_node(block))).norm());
    for (const int down : {-1, 1})
      for (const int right : {-1, 1})
        if (down > 0 || ring == 0)
          diagonal = std::max(
              diagonal,
              (at(nodes.neighbour(ring, node % nodes.n_azimuth, down, right)) -
               at(node))
                  .norm());
  }
  rest = half_square *
         (series ? largest_second_derivative(*series, farthest) : 1.);
  widest = 0.5 * double{diagonal} + rest;
}

void RadiusMap::measure_hull()
{
  Summits summits(*this);
  std::vector<double> heights;
  for (int side = 0; side < sides.size(); ++side)
  {
    summit.push_back(summits.along(side));
    const Eigen::Vector3f top = point(summit.back());
    heights.push_back(
        top.dot(side_directions()[static_cast<std::size_t>(side)]));
  }
  hull = GridValues(sides, heights);
  // Along a side the height of a point p is p.n: in the bilinear table between
  // four sides it may be missed by step^2 / 8 |p| for either angle. The rest is
  // that of single precision and of DirectionGrid::locate.
  constexpr double step = std::numbers::pi / sides.n_polar;
  static_assert(sides.n_azimuth == 2 * sides.n_polar);
  hull_tolerance = (0.25 * step * step + 1e-4) * farthest;
}

RadiusMap::Height RadiusMap::height(const Vec3 &direction) const
{
  const DirectionGrid::Position at = sides.locate(direction);
  const double upper = (1. - at.right) * hull.at(at.ring, at.column) +
                       at.right * hull.at(at.ring, at.column + 1);
  const double lower = (1. - at.right) * hull.at(at.ring + 1, at.column) +
                       at.right * hull.at(at.ring + 1, at.column + 1);
  const int ring = std::clamp(at.ring + (at.down > 0.5), 0, sides.n_polar - 1);
  const int side =
      ring * sides.n_azimuth + (at.column + (at.right > 0.5)) % sides.n_azimuth;
  return {(1. - at.down) * upper + at.down * lower + hull_tolerance,
          summit[static_cast<std::size_t>(side)]};
}
} // namespace dem
