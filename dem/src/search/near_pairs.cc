#include <dem/search/cell_grid.h>
#include <dem/search/near_pairs.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace dem
{
namespace
{
/// Stones whose reach is within a factor of two, in their grid.
struct SizeClass
{
  double largest = 0.; ///< reach [m]
  std::vector<std::int32_t> stone;
  CellGrid grid;
};

/// How far a stone can meet others from its centre.
std::vector<double> reaches(const Particles &particles,
                            ContactGeometry geometry)
{
  if (geometry == ContactGeometry::ball)
    return particles.column(&StoneState::radius);
  std::vector<double> reach(particles.size());
  for (std::size_t i = 0; i < reach.size(); ++i)
    reach[i] = particles.body[i].circumscribed_radius;
  return reach;
}

/// Radius of stone i along a world direction [m].
double local_radius(const Particles &particles, std::size_t i,
                    const Vec3 &direction)
{
  const Body &body = particles.body[i];
  if (!body.series)
    return particles.radius(i);
  const Vec3 on_body = particles.orientation(i).conjugate() * direction;
  return body.scale * radius(*body.series, on_body.normalized());
}

/// Number of the class of each stone, the smallest stones in class 0.
std::vector<int> classify(const std::vector<double> &reach)
{
  const double smallest = *std::min_element(reach.begin(), reach.end());
  std::vector<int> number(reach.size());
  for (std::size_t i = 0; i < reach.size(); ++i)
    number[i] = static_cast<int>(std::log2(reach[i] / smallest));
  return number;
}

/// Gap between the balls, or between the radii along the branch [m].
double gap_between(const Particles &particles, ContactGeometry geometry,
                   const PairKey &pair)
{
  const auto i = static_cast<std::size_t>(pair.first),
             j = static_cast<std::size_t>(pair.second);
  const Vec3 branch = particles.position(j) - particles.position(i);
  const double distance = branch.norm();
  const double balls = distance - particles.radius(i) - particles.radius(j);
  if (geometry == ContactGeometry::ball || distance == 0.)
    return balls;
  const Vec3 normal = branch / distance;
  return distance - local_radius(particles, i, normal) -
         local_radius(particles, j, -normal);
}

/// How far two stones may have come nearer each other in all [m].
double travelled(const Particles &particles, const PairKey &pair,
                 const Travel &travel)
{
  return particles.has_shapes
             ? particles.travelled[static_cast<std::size_t>(pair.first)] +
                   particles.travelled[static_cast<std::size_t>(pair.second)]
             : travel.gaps;
}

/// All pairs whose bounding spheres come within a margin. Stones are filed by
/// size: classes of a factor of two with a grid each, so that the cost per
/// stone does not grow with the ratio of sizes.
class PairSearch
{
public:
  PairSearch(const Particles &stones, ContactGeometry geometry, double gap)
      : particles(stones), margin(gap), reach(reaches(stones, geometry)),
        class_of(classify(reach))
  {
    classes.resize(static_cast<std::size_t>(
                       *std::max_element(class_of.begin(), class_of.end())) +
                   1);
    for (std::size_t i = 0; i < reach.size(); ++i)
    {
      SizeClass &own = classes[static_cast<std::size_t>(class_of[i])];
      own.stone.push_back(static_cast<std::int32_t>(i));
      own.largest = std::max(own.largest, reach[i]);
    }
    for (SizeClass &one : classes)
    {
      std::vector<Vec3> points;
      points.reserve(one.stone.size());
      for (const std::int32_t stone : one.stone)
        points.push_back(particles.position(static_cast<std::size_t>(stone)));
      one.grid = CellGrid(points, one.stone, one.largest + 0.5 * margin);
    }
  }

  /// Partners of stone i in its own class with a higher number and in the
  /// classes of larger stones.
  void find(std::size_t i, std::vector<PairKey> &pairs) const
  {
    const Vec3 &x = particles.position(i);
    const auto own = static_cast<std::size_t>(class_of[i]);
    for (std::size_t c = own; c < classes.size(); ++c)
    {
      const double range = reach[i] + classes[c].largest + margin;
      const Vec3 box = Vec3::Constant(range);
      classes[c].grid.visit_box(
          x - box, x + box,
          [&](std::int32_t other, const Vec3 &place)
          {
            const auto j = static_cast<std::size_t>(other);
            if ((c > own || j > i) && is_near(i, j, place - x))
              pairs.emplace_back(static_cast<std::int32_t>(std::min(i, j)),
                                 static_cast<std::int32_t>(std::max(i, j)));
          });
    }
  }

private:
  bool is_near(std::size_t i, std::size_t j, const Vec3 &branch) const
  {
    const double range = reach[i] + reach[j] + margin;
    return branch.squaredNorm() < range * range;
  }

  const Particles &particles;
  double margin;
  std::vector<double> reach;
  std::vector<int> class_of;
  std::vector<SizeClass> classes;
};

/// Sorts by first, then by second: a counting sort of short rows.
std::vector<PairKey> sorted(const std::vector<std::vector<PairKey>> &parts,
                            std::size_t n_stones)
{
  std::vector<std::int32_t> start(n_stones + 1, 0);
  for (const auto &part : parts)
    for (const PairKey &pair : part)
      ++start[static_cast<std::size_t>(pair.first) + 1];
  for (std::size_t i = 0; i < n_stones; ++i)
    start[i + 1] += start[i];
  std::vector<PairKey> all(static_cast<std::size_t>(start.back()));
  std::vector<std::int32_t> next(start.begin(), start.end() - 1);
  for (const auto &part : parts)
    for (const PairKey &pair : part)
      all[static_cast<std::size_t>(
          next[static_cast<std::size_t>(pair.first)]++)] = pair;
  for (std::size_t i = 0; i < n_stones; ++i)
    std::sort(all.begin() + start[i], all.begin() + start[i + 1]);
  return all;
}
/// All pairs whose bounding spheres come within a range, sorted.
std::vector<PairKey> within(const Particles &particles,
                            ContactGeometry geometry, double range)
{
  const PairSearch grids(particles, geometry, range);
  constexpr std::size_t part_size = 256;
  const std::size_t n = particles.size();
  std::vector<std::vector<PairKey>> parts((n + part_size - 1) / part_size);
#pragma omp parallel for schedule(dynamic)
  for (std::size_t p = 0; p < parts.size(); ++p)
    for (std::size_t i = p * part_size; i < std::min(n, (p + 1) * part_size);
         ++i)
      grids.find(i, parts[p]);
  return sorted(parts, n);
}
} // namespace

std::vector<PairKey> PairFinder::find(const Particles &particles,
                                      ContactGeometry geometry, double margin,
                                      const Travel &travel)
{
  // Wide enough for some rebuilds, narrow enough to be short: gaps of spheres
  // are had for less than the memory of their candidates.
  const double widening = particles.has_shapes ? 8. : 3.;
  if (particles.size() == 0)
    return {};
  if (reach < travel.centres + margin)
    search(particles, geometry, widening * margin, travel);
  constexpr std::size_t part_size = 4096;
  std::vector<std::vector<PairKey>> parts((candidates.size() + part_size - 1) /
                                          part_size);
#pragma omp parallel for schedule(dynamic)
  for (std::size_t p = 0; p < parts.size(); ++p)
    for (std::size_t c = p * part_size;
         c < std::min(candidates.size(), (p + 1) * part_size); ++c)
    {
      Candidate &one = candidates[c];
      const double now = travelled(particles, one.stones, travel);
      if (one.least - now >= margin)
        continue;
      if (one.most + now >= margin)
      {
        const double gap = gap_between(particles, geometry, one.stones);
        one.least = gap + now;
        one.most = gap - now;
        if (gap >= margin)
          continue;
      }
      parts[p].push_back(one.stones);
    }
  std::vector<PairKey> pairs;
  for (const auto &part : parts)
    pairs.insert(pairs.end(), part.begin(), part.end());
  return pairs;
}

PairFinder::Candidate PairFinder::between_spheres(const Particles &particles,
                                                  const PairKey &pair,
                                                  double travelled)
{
  const auto i = static_cast<std::size_t>(pair.first),
             j = static_cast<std::size_t>(pair.second);
  const Body &a = particles.body[i], &b = particles.body[j];
  const double distance =
      (particles.position(j) - particles.position(i)).norm();
  return {pair,
          distance - a.circumscribed_radius - b.circumscribed_radius +
              travelled,
          distance - a.least_radius - b.least_radius - travelled};
}

void PairFinder::search(const Particles &particles, ContactGeometry geometry,
                        double range, const Travel &travel)
{
  // What is known of a pair still holds.
  const std::vector<Candidate> before = std::exchange(candidates, {});
  auto known = before.begin();
  const std::vector<PairKey> all = within(particles, geometry, range);
  candidates.reserve(all.size());
  for (const PairKey &pair : all)
  {
    while (known != before.end() && known->stones < pair)
      ++known;
    candidates.push_back(
        known != before.end() && known->stones == pair
            ? *known
            : between_spheres(particles, pair,
                              travelled(particles, pair, travel)));
  }
  reach = travel.centres + range;
}

std::vector<PairKey> near_spheres(const Particles &particles, double margin)
{
  return within(particles, ContactGeometry::surface, margin);
}
} // namespace dem
