// Where pairs of particles meet, against a brute force that knows nothing but
// the radius of the series: the table of docs/verification/surfaces.md.
//
//   surface_pairs N SEED LARGEST SHAPES [SHAPES ...]
//
// N pairs that are apart or overlap by up to LARGEST of the smaller radius.
// Pairs that both do not agree on go to stderr, a line each.
#include "brute_force.h"

#include <dem/neighbor/contact_point_lists.h>
#include <dem/neighbor/contact_points.h>
#include <dem/random.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <shape/file.h>
#include <string>
#include <vector>

namespace
{
using dem::ParticleShape;
using dem::Vec3;
using support::processor_time;
using support::Tally;
using Particle = support::MappedBody;

Vec3 on_surface(const ParticleShape &body, const Vec3 &s)
{
  return body.scale * dem::radius(*body.series, s) * s;
}

/// Follows a function of directions downhill; returns the least value.
template <std::size_t n, class Value>
double compass(std::array<Vec3, n> &at, double step, const Value &value)
{
  double best = value(at);
  // Ravines take thousands of rounds.
  for (int round = 0; step > 2e-8 && round < 100000; ++round)
  {
    bool is_better = false;
    for (std::size_t side = 0; side < n; ++side)
    {
      const Vec3 first = at[side].unitOrthogonal(),
                 second = at[side].cross(first);
      for (const Vec3 &move : {first, Vec3(-first), second, Vec3(-second)})
      {
        std::array<Vec3, n> next = at;
        next[side] = (at[side] + step * move).normalized();
        if (const double there = value(next); there < best)
        {
          best = there;
          at = next;
          is_better = true;
        }
      }
    }
    if (!is_better)
      step *= 0.5;
  }
  return best;
}

/// Two particles, B as A sees it, with dense points of both in the frame of A.
struct Pair
{
  const ParticleShape &a, &b;
  dem::RelativePose pose;

  double distance(const std::array<Vec3, 2> &s) const
  {
    return (on_surface(a, s[0]) - pose.position -
            pose.rotation * on_surface(b, s[1]))
        .norm();
  }
  bool is_inside_b(const Vec3 &x) const
  {
    const Vec3 in_b = pose.rotation.transpose() * (x - pose.position);
    return in_b.norm() < on_surface(b, in_b.normalized()).norm();
  }
};

struct Start
{
  double value = 0.;
  std::array<Vec3, 2> at;
};

constexpr dem::DirectionGrid grid{32, 64};

/// For every node of A about B the nearest node of B, the least distance first;
/// nodes inside B have negative ones.
std::vector<Start> nearest_nodes(const Pair &pair)
{
  std::vector<Vec3> directions, of_b;
  for (int node = 0; node < grid.size(); ++node)
  {
    directions.push_back(
        grid.direction(node / grid.n_azimuth, node % grid.n_azimuth));
    of_b.push_back(pair.pose.position +
                   pair.pose.rotation * on_surface(pair.b, directions.back()));
  }
  std::vector<Start> starts;
  for (const Vec3 &s : directions)
  {
    const Vec3 x = on_surface(pair.a, s);
    if ((x - pair.pose.position).norm() > 1.2 * pair.b.circumscribed_radius)
      continue;
    Start start{1e9, {s, s}};
    for (std::size_t j = 0; j < of_b.size(); ++j)
      if (const double d = (of_b[j] - x).norm(); d < start.value)
        start = {d, {s, directions[j]}};
    if (pair.is_inside_b(x))
      start.value = -start.value;
    starts.push_back(start);
  }
  std::sort(starts.begin(), starts.end(),
            [](const Start &p, const Start &q) { return p.value < q.value; });
  return starts;
}

/// The point downhill of this one where the distance is least; its value is the
/// overlap < 0.
Start nearest_from(const Pair &pair, Start point)
{
  point.value =
      -compass(point.at, 0.03,
               [&](const std::array<Vec3, 2> &s) { return pair.distance(s); });
  return point;
}

/// The point of A downhill of this one that is deepest below the surface of
/// B, and the one of B nearest to it; its value is the depth.
Start deepest_from(const Pair &pair, const Start &from)
{
  const auto nearest_on_b = [&](const Vec3 &s)
  {
    Start point{0., {s, from.at[1]}};
    std::array<Vec3, 1> t = {from.at[1]};
    point.value = compass(t, 0.01,
                          [&](const std::array<Vec3, 1> &at) {
                            return pair.distance({s, at[0]});
                          });
    point.at[1] = t[0];
    return point;
  };
  std::array<Vec3, 1> on_a = {from.at[0]};
  const double least = compass(
      on_a, 0.03,
      [&](const std::array<Vec3, 1> &s)
      {
        const double depth = nearest_on_b(s[0]).value;
        return pair.is_inside_b(on_surface(pair.a, s[0])) ? -depth : depth;
      });
  return {-least, nearest_on_b(on_a[0]).at};
}

constexpr double apart = 0.15; ///< between nodes or contact points [rad]

bool are_beside(const Vec3 &one, const Vec3 &other)
{
  return (one - other).norm() < apart;
}

/// The best nodes, none of them beside a better one.
std::vector<Start> distinct_starts(const std::vector<Start> &nodes,
                                   std::size_t n)
{
  std::vector<Start> chosen;
  for (const Start &start : nodes)
  {
    const auto is_beside = [&start](const Start &better)
    { return are_beside(start.at[0], better.at[0]); };
    if (std::none_of(chosen.begin(), chosen.end(), is_beside))
      chosen.push_back(start);
    if (chosen.size() == n)
      break;
  }
  return chosen;
}

/// Nodes within `reach` with none better beside them.
std::vector<Start> least_starts(const std::vector<Start> &nodes, double reach)
{
  std::vector<Start> chosen;
  for (std::size_t k = 0; k < nodes.size() && nodes[k].value < reach; ++k)
  {
    const auto is_beside = [&](const Start &better)
    { return are_beside(nodes[k].at[0], better.at[0]); };
    if (std::none_of(nodes.begin(),
                     nodes.begin() + static_cast<std::ptrdiff_t>(k), is_beside))
      chosen.push_back(nodes[k]);
  }
  return chosen;
}

Start downhill(const Pair &pair, const Start &start, bool is_apart)
{
  return is_apart ? nearest_from(pair, start) : deepest_from(pair, start);
}

/// The best point from the best nodes: nearest, or deepest.
Start best_point(const Pair &pair, const std::vector<Start> &nodes,
                 bool is_apart)
{
  const std::size_t n_starts = is_apart ? 8 : 4;
  Start best{-1e9, {}};
  for (const Start &start : distinct_starts(nodes, n_starts))
  {
    const Start point = downhill(pair, start, is_apart);
    if (point.value > best.value)
      best = point;
  }
  return best;
}

/// Whether a contact point of the brute force is one of those of the search.
bool is_among(const Start &point,
              const std::vector<dem::ContactPoint> &contact_points)
{
  return std::any_of(contact_points.begin(), contact_points.end(),
                     [&](const dem::ContactPoint &contact_point)
                     { return are_beside(contact_point.on_a, point.at[0]); });
}

/// Further contact points, beside the deepest, and how many of them are missed.
struct Further
{
  int n = 0, n_missed = 0;
  double largest = -1.;   ///< missed overlap over the diameter
  std::size_t n_most = 0; ///< contact points of one pair, by the search
  int n_beyond = 0;       ///< pairs with more than are followed

  void look(const Pair &pair, const std::vector<Start> &nodes, bool is_apart,
            double margin, const std::vector<dem::ContactPoint> &contact_points)
  {
    n_most = std::max(n_most, contact_points.size());
    n_beyond += contact_points.size() > dem::most_contact_points;
    std::vector<Start> seen;
    for (const Start &start : least_starts(nodes, 0.08 * diameter(pair)))
    {
      const Start point = downhill(pair, start, is_apart);
      const auto is_known = [&](const Start &other)
      { return are_beside(other.at[0], point.at[0]); };
      if (point.value < (is_apart ? -margin : 0.) ||
          (!contact_points.empty() &&
           are_beside(contact_points.front().on_a, point.at[0])) ||
          std::any_of(seen.begin(), seen.end(), is_known))
        continue;
      seen.push_back(point);
      ++n;
      if (is_among(point, contact_points))
        continue;
      ++n_missed;
      largest = std::max(largest, point.value / diameter(pair));
      const dem::ContactPoint polished = dem::refine(
          pair.a, pair.b, pair.pose, {point.at[0], point.at[1], 0., true});
      std::fprintf(stderr,
                   "further contact point, %s: brute force %.3e, search from "
                   "there %s %.3e, %.2f rad from it\n",
                   is_apart ? "apart" : "overlapping",
                   point.value / diameter(pair),
                   polished.is_found ? "found" : "lost",
                   polished.overlap / diameter(pair),
                   (polished.on_a - point.at[0]).norm());
    }
  }
  static double diameter(const Pair &pair)
  {
    return 2. * dem::mean_radius(pair.b);
  }
};

dem::ContactPointSearch search(const dem::MappedPair &pair, double margin)
{
  return dem::find_contact_points(
      pair, dem::separate(pair, pair.pose.position.normalized()), margin);
}

/// B comes nearer along a line until the deepest overlap is as wanted.
dem::MappedPair approach(const dem::MappedPair &from, double overlap)
{
  const double size = dem::mean_radius(from.b.body);
  dem::MappedPair pair = from;
  const Vec3 along = pair.pose.position.normalized();
  double distance = pair.pose.position.norm();
  for (int step = 0; step < 400; ++step)
  {
    pair.pose.position = distance * along;
    const dem::ContactPointSearch found = search(pair, 0.2 * size);
    const double now = found.contact_points.empty()
                           ? -0.2 * size
                           : found.contact_points.front().overlap;
    if (now > overlap - 1e-4 * size)
      break;
    distance -= std::max(0.3 * (overlap - now), 1e-4 * size);
  }
  return pair;
}

/// What each of two contact points is for the other: where the brute force gets
/// from the contact point of the search, and the polishing of the search from
/// that of the brute force.
void report(int number, const Pair &pair, const dem::ContactPoint &found,
            const Start &exact)
{
  const double diameter = 2. * dem::mean_radius(pair.b);
  const bool is_apart = found.overlap <= 0.;
  const Start from_search{0., {found.on_a, found.on_b}};
  const double by_force = (is_apart ? nearest_from(pair, from_search)
                                    : deepest_from(pair, from_search))
                              .value;
  const dem::ContactPoint polished = dem::refine(
      pair.a, pair.b, pair.pose, {exact.at[0], exact.at[1], 0., true});
  std::fprintf(
      stderr,
      "pair %d %s: search %.3e (brute force from there %.3e), brute "
      "force %.3e (search from there %.3e%s), %.2f rad apart\n",
      number, is_apart ? "apart" : "overlapping", found.overlap / diameter,
      by_force / diameter, exact.value / diameter, polished.overlap / diameter,
      polished.is_found ? "" : ", lost", (found.on_a - exact.at[0]).norm());
}

void compare(int number, const dem::MappedPair &pair, double largest,
             Tally &tally, Further &further)
{
  const double size = dem::mean_radius(pair.b.body);
  const double margin = 2. * largest * size;
  const double before = processor_time();
  const dem::ContactPointSearch search_result = search(pair, margin);
  tally.seconds += processor_time() - before;
  tally.n_several += search_result.contact_points.size() > 1;
  const dem::ContactPoint found = search_result.contact_points.empty()
                                      ? dem::ContactPoint{.overlap = -margin}
                                      : search_result.contact_points.front();
  const Pair both{pair.a.body, pair.b.body, pair.pose};
  const std::vector<Start> nodes = nearest_nodes(both);
  const bool is_apart = found.overlap <= 0.;
  const Start exact = best_point(both, nodes, is_apart);
  further.look(both, nodes, is_apart, margin, search_result.contact_points);
  if (!tally.add(exact.value / (2. * size), found.overlap / (2. * size)))
    report(number, both, found, exact);
}
} // namespace

int main(int argc, char **argv)
{
  if (argc < 5)
  {
    std::fprintf(stderr, "surface_pairs N SEED LARGEST SHAPES [SHAPES ...]\n");
    return 1;
  }
  const double largest = std::stod(argv[3]);
  std::vector<Particle> particles;
  for (int k = 4; k < argc; ++k)
    for (const spall::ShapeFile &shape : spall::read_shapes(argv[k]))
      particles.emplace_back(shape.coefficients);
  dem::Random random(std::stoull(argv[2]));
  std::array<Tally, 2> tallies;
  std::array<Further, 2> further;
  for (int k = 0; k < std::stoi(argv[1]); ++k)
  {
    const auto pick = [&]
    {
      return static_cast<std::size_t>(random.uniform() *
                                      static_cast<double>(particles.size()));
    };
    const Particle &one = particles[pick()], &other = particles[pick()];
    const ParticleShape a = dem::resized(one.body, 1.),
                        b = dem::resized(other.body,
                                         std::pow(1. / 3., random.uniform()));
    const dem::Mat3 rotation = random.rotation().toRotationMatrix();
    const Vec3 along = random.rotation() * Vec3::UnitX();
    const double reach = a.circumscribed_radius + b.circumscribed_radius;
    const bool is_apart = k % 2 == 0;
    const double overlap = (is_apart ? -1. : 1.) * largest *
                           (0.05 + 0.95 * random.uniform()) *
                           dem::mean_radius(b);
    compare(k,
            approach({{a, one.map}, {b, other.map}, {reach * along, rotation}},
                     overlap),
            largest, tallies[is_apart ? 0 : 1], further[is_apart ? 0 : 1]);
  }
  std::printf("| pairs | number | search misses the nearest contact point | "
              "brute force "
              "misses it | worst error of the others over the diameter | more "
              "than one contact point | us per search |\n"
              "|---|---|---|---|---|---|---|\n");
  for (std::size_t k = 0; k < 2; ++k)
    std::printf("| %s | %d | %d | %d | %.1e | %.1f %% | %.0f |\n",
                k == 0 ? "apart" : "overlapping", tallies[k].n,
                tallies[k].n_missed, tallies[k].n_beaten, tallies[k].worst,
                100. * tallies[k].n_several / std::max(1, tallies[k].n),
                1e6 * tallies[k].seconds / std::max(1, tallies[k].n));
  std::printf(
      "\n| pairs | further contact points | of them missed | largest missed "
      "over the diameter | most contact points of one pair | pairs with more "
      "than %zu |\n|---|---|---|---|---|---|\n",
      dem::most_contact_points);
  for (std::size_t k = 0; k < 2; ++k)
  {
    std::printf("| %s | %d | %d | ", k == 0 ? "apart" : "overlapping",
                further[k].n, further[k].n_missed);
    if (further[k].n_missed > 0)
      std::printf("%.1e", further[k].largest);
    std::printf(" | %zu | %d |\n", further[k].n_most, further[k].n_beyond);
  }
}
