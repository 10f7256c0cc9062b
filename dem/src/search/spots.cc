#include "node_minima.h"

#include <dem/search/spots.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace dem
{
namespace
{
constexpr double far = std::numeric_limits<double>::infinity();
constexpr DirectionGrid nodes = RadiusMap::nodes;
/// Nodes of the first look: every second ring and column.
constexpr int stride = 2;
/// A node may be nearer than one of the first look beside it by at most this
/// part of the radius.
constexpr double coarse_slack = 0.15;
/// The gap between nodes may be smaller by this part of the radius: a sharp
/// corner between them.
constexpr double fine_slack = 0.08;
/// Two places on a stone nearer than this are one [rad].
constexpr double one_place = 0.03;

RelativePose inverted(const RelativePose &pose)
{
  const Mat3 back = pose.rotation.transpose();
  return {-(back * pose.position), back};
}

/// Two stones with the one first whose nodes are looked at.
struct Ordered
{
  const MappedStone &sampled, &field;
  RelativePose pose;  ///< of the field as the sampled stone sees it
  Separation between; ///< from the sampled stone to the field
  bool is_swapped = false;
};

std::array<Ordered, 2> both_ways(const MappedPair &pair,
                                 const Separation &separation)
{
  const Separation back{
      Vec3(-(pair.pose.rotation.transpose() * separation.normal)),
      separation.gap};
  return {Ordered{pair.a, pair.b, pair.pose, separation, false},
          Ordered{pair.b, pair.a, inverted(pair.pose), back, true}};
}

/// Nodes of one stone in the field |x| - r(x / |x|) of another.
class NodeGaps
{
public:
  /// Looks at every node that may be within `range` of the field.
  NodeGaps(const Ordered &pair, double range)
      : search(pair), scale(pair.sampled.body.scale),
        slab(pair.between.normal.cast<float>() * static_cast<float>(scale))
  {
    gap.fill(far);
    const double slack = coarse_slack * mean_radius(pair.sampled.body);
    // Nothing of the field is lower along the normal.
    const double face =
        pair.sampled.map.height(pair.between.normal).height * scale +
        pair.between.gap;
    const auto lowest = static_cast<float>(face - range - slack);
    for (int i = 0; i < nodes.n_polar; i += stride)
      for (int k = 0; k < nodes.n_azimuth; k += stride)
      {
        const int node = i * nodes.n_azimuth + k;
        if (search.sampled.map.point(node).dot(slab) > lowest &&
            gap_at(node, range + slack) < range + slack)
          look_around(i, k, range);
      }
  }

  /// Calls call(node, gap) for every local minimum.
  template <class Call>
  void for_minima(const Call &call) const
  {
    for (const int node : looked_at)
      if (is_minimum(node))
        call(node, gap[static_cast<std::size_t>(node)]);
  }

  Vec3 position(int node) const
  {
    return scale * search.sampled.map.point(node).cast<double>();
  }

private:
  /// From node to field: along the ray from the centre of the field, times the
  /// cosine of the surface there; infinite where the node is farther than
  /// `range` from all of it.
  double gap_at(int node, double range) const
  {
    const Vec3 branch = position(node) - search.pose.position;
    const Body &field = search.field.body;
    const double reach = field.circumscribed_radius + range;
    const double square = branch.squaredNorm();
    if (square > reach * reach)
      return far;
    const RadiusMap::Look look =
        search.field.map.towards(search.pose.rotation.transpose() * branch);
    return look.cosine * (std::sqrt(square) - field.scale * look.radius);
  }

  void look_around(int i, int k, double range)
  {
    for (int down = 0; down < stride; ++down)
      for (int right = 0; right < stride; ++right)
      {
        const int node = (i + down) * nodes.n_azimuth + k + right;
        gap[static_cast<std::size_t>(node)] = gap_at(node, range);
        looked_at.push_back(node);
      }
  }

  bool is_minimum(int node) const
  {
    return gap[static_cast<std::size_t>(node)] < far && is_least_gap(gap, node);
  }

  const Ordered &search;
  double scale;
  Eigen::Vector3f slab;
  std::array<double, static_cast<std::size_t>(nodes.size())> gap;
  std::vector<int> looked_at;
};

bool is_listed(const Spot &spot, std::span<const Spot> list)
{
  return std::any_of(list.begin(), list.end(),
                     [&](const Spot &other)
                     { return is_one_place(spot, other); });
}

/// Whether a minimum of the maps is that of a place in the list: two places
/// may be nearer than the nodes, so only the near half of a node's share is.
bool leads_to(const Spot &start, std::span<const Spot> list)
{
  constexpr double node_spacing = std::numbers::pi / nodes.n_polar;
  return std::any_of(list.begin(), list.end(),
                     [&](const Spot &spot)
                     {
                       return (start.on_a - spot.on_a).squaredNorm() <
                              0.25 * node_spacing * node_spacing;
                     });
}

/// The nearest first.
void sort_spots(std::vector<Spot> &spots)
{
  std::sort(spots.begin(), spots.end(),
            [](const Spot &one, const Spot &other)
            { return one.overlap > other.overlap; });
}

Spot start_at(const Ordered &search, const Vec3 &position)
{
  Spot start;
  start.on_a = position.normalized();
  start.on_b =
      (search.pose.rotation.transpose() * (position - search.pose.position))
          .normalized();
  if (search.is_swapped)
    std::swap(start.on_a, start.on_b);
  return start;
}

/// Gap of the hulls along a unit vector, and the vector between their summits.
struct HullGap
{
  double gap = 0.;
  Vec3 between = Vec3::Zero();
};

HullGap hull_gap(const MappedPair &pair, const Vec3 &normal)
{
  const Vec3 on_b = -(pair.pose.rotation.transpose() * normal);
  const RadiusMap::Height a = pair.a.map.height(normal),
                          b = pair.b.map.height(on_b);
  const double scale_a = pair.a.body.scale, scale_b = pair.b.body.scale;
  const Vec3 top_a = scale_a * pair.a.map.point(a.node).cast<double>();
  const Vec3 top_b = scale_b * pair.b.map.point(b.node).cast<double>();
  return {pair.pose.position.dot(normal) - scale_a * a.height -
              scale_b * b.height,
          pair.pose.position + pair.pose.rotation * top_b - top_a};
}
} // namespace

bool is_one_place(const Spot &one, const Spot &other)
{
  return (one.on_a - other.on_a).squaredNorm() < one_place * one_place;
}

Separation separate(const MappedPair &pair, const Vec3 &guess)
{
  constexpr int most_steps = 8;
  HullGap now = hull_gap(pair, guess);
  Separation best{guess, now.gap};
  // Nearest point to the origin of the segment from the last one to the new
  // summits: a point of the difference of the hulls.
  Vec3 nearest = now.between;
  for (int step = 0; step < most_steps; ++step)
  {
    const double length = nearest.norm();
    if (length == 0. || best.gap > 0.9 * length)
      break;
    const Vec3 normal = nearest / length;
    now = hull_gap(pair, normal);
    if (now.gap > best.gap)
      best = {normal, now.gap};
    const Vec3 edge = now.between - nearest;
    const double square = edge.squaredNorm();
    if (square == 0.)
      break;
    nearest += std::clamp(-nearest.dot(edge) / square, 0., 1.) * edge;
  }
  return best;
}

bool may_touch(const MappedPair &pair, double margin)
{
  const Separation separation = separate(pair, pair.pose.position.normalized());
  if (separation.gap > margin)
    return false;
  const auto ways = both_ways(pair, separation);
  return std::any_of(ways.begin(), ways.end(),
                     [&](const Ordered &search)
                     {
                       bool is_near = false;
                       NodeGaps(search, margin)
                           .for_minima([&](int, double gap)
                                       { is_near |= gap < margin; });
                       return is_near;
                     });
}

SpotSearch find_spots(const MappedPair &pair, const Separation &separation,
                      double margin, std::span<const Spot> known)
{
  SpotSearch found;
  const Body &a = pair.a.body, &b = pair.b.body;
  const double size = std::min(mean_radius(a), mean_radius(b));
  // A corner of one may fall between the nodes of the other.
  for (const Ordered &search : both_ways(pair, separation))
  {
    const double range = margin + fine_slack * mean_radius(search.sampled.body);
    const NodeGaps gaps(search, range);
    gaps.for_minima(
        [&](int node, double gap)
        {
          const Spot start = start_at(search, gaps.position(node));
          if (gap > range || leads_to(start, known) ||
              leads_to(start, found.spots))
            return;
          const Spot spot = polish(a, b, pair.pose, start);
          if (!spot.is_found)
            ++found.n_lost;
          else if (spot.overlap > -margin &&
                   spot.overlap < deepest_overlap * size &&
                   !is_listed(spot, known) && !is_listed(spot, found.spots))
            found.spots.push_back(spot);
        });
  }
  sort_spots(found.spots);
  return found;
}

std::vector<Spot> find_supports(const MappedStone &stone, const Vec3 &normal,
                                const SupportHeights &heights,
                                std::span<const Spot> known)
{
  const Eigen::Vector3f up =
      static_cast<float>(stone.body.scale) * normal.cast<float>();
  const auto lowest =
      static_cast<float>(heights.lowest - fine_slack * mean_radius(stone.body));
  const auto height = [&](int node) { return stone.map.point(node).dot(up); };
  const auto is_summit = [&](int node)
  {
    const float own = height(node);
    for (int down = -1; down <= 1; ++down)
      for (int right = -1; right <= 1; ++right)
        if (height(nodes.neighbour(node / nodes.n_azimuth,
                                   node % nodes.n_azimuth, down, right)) > own)
          return false;
    return true;
  };
  std::vector<Spot> found;
  for (int node = 0; node < nodes.size(); ++node)
  {
    if (height(node) < lowest || !is_summit(node))
      continue;
    const Support support = find_support(
        stone.body, normal, stone.map.point(node).cast<double>().normalized());
    const Spot spot{support.direction, Vec3::UnitZ(),
                    support.height - heights.wall, support.is_found};
    if (spot.is_found && support.height > heights.lowest &&
        !is_listed(spot, known) && !is_listed(spot, found))
      found.push_back(spot);
  }
  sort_spots(found);
  return found;
}
} // namespace dem
