#include "node_list.h"
#include "node_minima.h"

#include <dem/neighbor/contact_points.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace dem
{
namespace
{
/// Where a map curves between its nodes against the rule of
/// NodeGaps::may_hide(), by this part of the radius at most.
constexpr double fine_tolerance = 0.02;
/// Two contact points on a particle nearer than this are one [rad].
constexpr double same_point_angle = 0.03;

RelativePose inverted(const RelativePose &pose)
{
  const Mat3 back = pose.rotation.transpose();
  return {-(back * pose.position), back};
}

/// Two particles, the one first whose nodes are checked.
struct Ordered
{
  const MappedParticle &sampled, &field;
  RelativePose pose;  ///< of the field relative to the sampled particle
  Separation between; ///< from the sampled particle to the field
  bool is_swapped = false;
};

std::array<Ordered, 2> both_ways(const MappedPair &pair,
                                 const Separation &separation)
{
  const Separation back{
      Vec3(-(pair.pose.rotation.transpose() * separation.normal)),
      separation.gap, separation.top_b, separation.top_a};
  return {Ordered{pair.a, pair.b, pair.pose, separation, false},
          Ordered{pair.b, pair.a, inverted(pair.pose), back, true}};
}

/// Calls call(position) for every node of one particle that is nearer to the
/// other one than its neighbours are, where the surface between them may come
/// within `skin` [m].
template <class Call>
void for_nearest_nodes(const Ordered &pair, double skin, const Call &call)
{
  const MappedParticle &sampled = pair.sampled;
  const double scale = sampled.body.scale;
  const double tolerance = fine_tolerance * mean_radius(sampled.body);
  // The node next to a contact point is no farther than the contact point but
  // for what the sharper of both surfaces curves on the way, which the other
  // does not exceed.
  const double range = skin + tolerance + 2. * scale * sampled.map.sag();
  // Nothing of the field is lower along the normal than this face.
  const double face = pair.between.top_a + pair.between.gap;
  NodeList list(sampled, pair.between.normal,
                face - range - scale * sampled.map.spacing());
  std::array<float, kernel::map_nodes + kernel::map_spare> gap;
  find_gaps(pair.field, pair.pose, range, list.points(), list.size(),
            gap.data());
  NodeGaps gaps;
  for (int k = 0; k < list.size(); ++k)
    gaps.set(list.node(k), gap[static_cast<std::size_t>(k)]);
  gaps.close();
  for (int k = 0; k < list.size(); ++k)
    if (const int node = list.node(k);
        gap[static_cast<std::size_t>(k)] < range && gaps.is_least(node) &&
        gap[static_cast<std::size_t>(k)] - gaps.may_hide(node) <
            skin + tolerance)
      call(list.position(k));
}

bool is_listed(const ContactPoint &contact_point,
               std::span<const ContactPoint> list)
{
  return std::any_of(list.begin(), list.end(),
                     [&](const ContactPoint &other)
                     { return is_one_contact_point(contact_point, other); });
}

/// Whether a minimum of the maps is that of a contact point in the list, both
/// on the particle whose node it is: two contact points may be nearer than the
/// nodes, so only the near half of a node's share is.
bool leads_to(const ContactPoint &start, std::span<const ContactPoint> list,
              Vec3 ContactPoint::*on_sampled = &ContactPoint::on_a)
{
  constexpr double node_spacing = std::numbers::pi / RadiusMap::nodes.n_polar;
  return std::any_of(
      list.begin(), list.end(),
      [&](const ContactPoint &contact_point)
      {
        return (start.*on_sampled - contact_point.*on_sampled).squaredNorm() <
               0.25 * node_spacing * node_spacing;
      });
}

/// The nearest first.
void sort_contact_points(std::vector<ContactPoint> &contact_points)
{
  std::sort(contact_points.begin(), contact_points.end(),
            [](const ContactPoint &one, const ContactPoint &other)
            { return one.overlap > other.overlap; });
}

ContactPoint start_at(const Ordered &search, const Vec3 &position)
{
  ContactPoint start;
  start.on_a = position.normalized();
  start.on_b =
      (search.pose.rotation.transpose() * (position - search.pose.position))
          .normalized();
  if (search.is_swapped)
    std::swap(start.on_a, start.on_b);
  return start;
}

/// Tops of the nodes of both maps along a unit vector, the gap between them and
/// the vector between their summits.
struct HullGap
{
  Separation slab;
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
  const double high_a = scale_a * a.height, high_b = scale_b * b.height;
  return {{normal, pair.pose.position.dot(normal) - high_a - high_b, high_a,
           high_b},
          pair.pose.position + pair.pose.rotation * top_b - top_a};
}

/// How much higher than its nodes a surface may be [m].
double sag_of(const MappedParticle &particle)
{
  return particle.body.scale * particle.map.sag();
}

/// Height of a particle along a unit vector of its body frame, on the series:
/// of the nodes that may lie beside its highest point the highest ones are
/// climbed from.
double top_of(const MappedParticle &particle, const Vec3 &normal)
{
  if (!particle.body.series)
    return particle.body.scale;
  const double nodes = particle.body.scale * particle.map.height(normal).height;
  const std::vector<ContactPoint> found =
      find_supports(particle, normal, {nodes - 2. * sag_of(particle), 0.});
  // The table of the nodes is a little higher than they are.
  return found.empty() ? nodes + sag_of(particle) : found.front().overlap;
}
} // namespace

bool is_one_contact_point(const ContactPoint &one, const ContactPoint &other)
{
  return (one.on_a - other.on_a).squaredNorm() <
         same_point_angle * same_point_angle;
}

Separation separate(const MappedPair &pair, const Vec3 &guess, double skin)
{
  constexpr int most_steps = 8;
  HullGap now = hull_gap(pair, guess);
  Separation best = now.slab;
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
    if (now.slab.gap > best.gap)
      best = now.slab;
    const Vec3 edge = now.between - nearest;
    const double square = edge.squaredNorm();
    if (square == 0.)
      break;
    nearest += std::clamp(-nearest.dot(edge) / square, 0., 1.) * edge;
  }
  // Surfaces may stand out between their nodes.
  const double rest_a = sag_of(pair.a), rest_b = sag_of(pair.b);
  const bool is_open = best.gap > skin && best.gap - rest_a - rest_b < skin;
  best.top_a = is_open ? top_of(pair.a, best.normal) : best.top_a + rest_a;
  best.top_b =
      is_open ? top_of(pair.b, -(pair.pose.rotation.transpose() * best.normal))
              : best.top_b + rest_b;
  best.gap = pair.pose.position.dot(best.normal) - best.top_a - best.top_b;
  return best;
}

bool may_touch(const MappedPair &pair, double skin)
{
  const Separation separation =
      separate(pair, pair.pose.position.normalized(), skin);
  if (separation.gap > skin)
    return false;
  const auto ways = both_ways(pair, separation);
  return std::any_of(ways.begin(), ways.end(),
                     [&](const Ordered &search)
                     {
                       bool is_near = false;
                       for_nearest_nodes(search, skin,
                                         [&](const Vec3 &) { is_near = true; });
                       return is_near;
                     });
}

ContactPointSearch find_contact_points(const MappedPair &pair,
                                       const Separation &separation,
                                       double skin,
                                       std::span<const ContactPoint> known)
{
  ContactPointSearch found;
  const ParticleShape &a = pair.a.body, &b = pair.b.body;
  const double size = std::min(mean_radius(a), mean_radius(b));
  // A corner of one may fall between the nodes of the other.
  for (const Ordered &search : both_ways(pair, separation))
  {
    const auto on_sampled =
        search.is_swapped ? &ContactPoint::on_b : &ContactPoint::on_a;
    for_nearest_nodes(
        search, skin,
        [&](const Vec3 &position)
        {
          const ContactPoint start = start_at(search, position);
          if (leads_to(start, known, on_sampled) ||
              leads_to(start, found.contact_points, on_sampled))
            return;
          const ContactPoint contact_point = refine(a, b, pair.pose, start);
          if (!contact_point.is_found)
            ++found.n_lost;
          else if (contact_point.overlap > -skin &&
                   contact_point.overlap < deepest_overlap * size &&
                   !is_listed(contact_point, known) &&
                   !is_listed(contact_point, found.contact_points))
            found.contact_points.push_back(contact_point);
        });
  }
  sort_contact_points(found.contact_points);
  return found;
}

std::vector<ContactPoint> find_supports(const MappedParticle &particle,
                                        const Vec3 &normal,
                                        const SupportHeights &heights,
                                        std::span<const ContactPoint> known)
{
  const double tolerance = fine_tolerance * mean_radius(particle.body);
  const NodeList list(particle, normal,
                      heights.lowest - tolerance - sag_of(particle));
  NodeGaps depths;
  for (int k = 0; k < list.size(); ++k)
    depths.set(list.node(k), -static_cast<float>(list.position(k).dot(normal)));
  depths.close();
  std::vector<ContactPoint> found;
  for (int k = 0; k < list.size(); ++k)
  {
    const int node = list.node(k);
    if (!depths.is_least(node) ||
        depths.at(node) - depths.may_hide(node) > tolerance - heights.lowest)
      continue;
    const ContactPoint start{list.position(k).normalized(), Vec3::UnitZ(), 0.,
                             false};
    if (leads_to(start, known) || leads_to(start, found))
      continue;
    const Support support = find_support(particle.body, normal, start.on_a);
    const ContactPoint contact_point{support.direction, Vec3::UnitZ(),
                                     support.height - heights.wall,
                                     support.is_found};
    if (contact_point.is_found && support.height > heights.lowest &&
        !is_listed(contact_point, known) && !is_listed(contact_point, found))
      found.push_back(contact_point);
  }
  sort_contact_points(found);
  return found;
}
} // namespace dem
