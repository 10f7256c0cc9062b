#include <dem/shape/quadrature.h>
#include <dem/shape/radius_map.h>

#include <algorithm>
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

const std::vector<Eigen::Vector3f> &node_directions()
{
  static const std::vector<Eigen::Vector3f> directions = []
  {
    std::vector<Eigen::Vector3f> all;
    for (const Vec3 &direction : node_rule().direction)
      all.push_back(direction.cast<float>());
    return all;
  }();
  return directions;
}

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

int RadiusMap::highest_neighbour(int node,
                                 const Eigen::Vector3f &direction) const
{
  const int ring = node / nodes.n_azimuth, column = node % nodes.n_azimuth;
  int best = node;
  for (int down = -1; down <= 1; ++down)
    for (int right = -1; right <= 1; ++right)
      if (const int other = nodes.neighbour(ring, column, down, right);
          point(other).dot(direction) > point(best).dot(direction))
        best = other;
  return best;
}

void RadiusMap::measure_hull()
{
  // Every second node of every second ring first: the hull of a stone that has
  // just broken is measured while others wait.
  std::vector<int> coarse_nodes;
  for (int i = 0; i < nodes.n_polar; i += 2)
    for (int k = 0; k < nodes.n_azimuth; k += 2)
      coarse_nodes.push_back(i * nodes.n_azimuth + k);
  const auto n = static_cast<Eigen::Index>(coarse_nodes.size());
  Eigen::Matrix<float, Eigen::Dynamic, 3> coarse(n, 3);
  for (Eigen::Index k = 0; k < n; ++k)
    coarse.row(k) = point(coarse_nodes[static_cast<std::size_t>(k)]);
  Eigen::VectorXf along(n);
  const auto highest = [&](const Eigen::Vector3f &direction)
  {
    along.noalias() = coarse * direction;
    // Twice through, as finding the place of the largest is not vectorised.
    const float *const top =
        std::find(along.data(), along.data() + n, along.maxCoeff());
    return highest_neighbour(
        coarse_nodes[static_cast<std::size_t>(top - along.data())], direction);
  };
  std::vector<double> heights;
  float largest = 0.f;
  for (int i = 0; i < sides.n_polar; ++i)
    for (int k = 0; k < sides.n_azimuth; ++k)
    {
      const Eigen::Vector3f direction = sides.direction(i, k).cast<float>();
      summit.push_back(highest(direction));
      heights.push_back(point(summit.back()).dot(direction));
      largest = std::max(largest, point(summit.back()).norm());
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
