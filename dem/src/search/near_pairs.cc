#include <dem/search/cell_grid.h>
#include <dem/search/near_pairs.h>

#include <algorithm>
#include <cmath>

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
std::vector<double> reaches(const Particles &particles, bool is_radial)
{
  if (!is_radial)
    return particles.column(&StoneState::radius);
  std::vector<double> reach(particles.size());
  for (std::size_t i = 0; i < reach.size(); ++i)
    reach[i] = particles.body[i].circumscribed_radius;
  return reach;
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

class PairSearch
{
public:
  PairSearch(const Particles &stones, bool radial, double gap)
      : particles(stones), is_radial(radial), margin(gap),
        reach(reaches(stones, radial)), class_of(classify(reach))
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
    const double square = branch.squaredNorm();
    const double range = reach[i] + reach[j] + margin;
    if (square >= range * range)
      return false;
    if (!is_radial || square == 0.)
      return true;
    const double distance = std::sqrt(square);
    const Body &a = particles.body[i], &b = particles.body[j];
    if (a.inscribed_radius + b.inscribed_radius + margin > distance)
      return true;
    const Vec3 normal = branch / distance;
    return local_radius(i, normal) + local_radius(j, -normal) + margin >
           distance;
  }

  /// Of the stone along a world direction [m].
  double local_radius(std::size_t i, const Vec3 &direction) const
  {
    const Body &body = particles.body[i];
    if (!body.series)
      return particles.radius(i);
    const Vec3 on_body = particles.orientation(i).conjugate() * direction;
    return body.scale * radius(*body.series, on_body.normalized());
  }

  const Particles &particles;
  bool is_radial;
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
} // namespace

std::vector<PairKey> near_pairs(const Particles &particles, bool is_radial,
                                double margin)
{
  if (particles.size() == 0)
    return {};
  const PairSearch search(particles, is_radial, margin);
  constexpr std::size_t part_size = 256;
  const std::size_t n = particles.size();
  std::vector<std::vector<PairKey>> parts((n + part_size - 1) / part_size);
#pragma omp parallel for schedule(dynamic)
  for (std::size_t p = 0; p < parts.size(); ++p)
    for (std::size_t i = p * part_size; i < std::min(n, (p + 1) * part_size);
         ++i)
      search.find(i, parts[p]);
  return sorted(parts, n);
}
} // namespace dem
