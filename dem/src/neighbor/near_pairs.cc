#include <dem/neighbor/cell_grid.h>
#include <dem/neighbor/near_pairs.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <stdexcept>
#include <utility>

namespace dem
{
namespace
{
/// Particles whose reach is within a factor of two, in their grid.
struct SizeClass
{
  double largest = 0.; ///< reach [m]
  std::vector<std::int32_t> particle;
  CellGrid grid;
};

/// How far a particle can meet others from its centre.
std::vector<double> reaches(const ParticleSystem &particles, bool reads_shape)
{
  if (!reads_shape)
    return particles.column(&ParticleState::radius);
  std::vector<double> reach(particles.size());
  for (std::size_t i = 0; i < reach.size(); ++i)
    reach[i] = particles.shape[i].circumscribed_radius;
  return reach;
}

/// Radius of particle i along a world direction [m].
double local_radius(const ParticleSystem &particles, std::size_t i,
                    const Vec3 &direction)
{
  const ParticleShape &body = particles.shape[i];
  if (!body.series)
    return particles.radius(i);
  const Vec3 on_body = particles.orientation(i).conjugate() * direction;
  return body.scale * radius(*body.series, on_body.normalized());
}

/// Number of the class of each particle, the smallest particles in class 0.
std::vector<int> classify(const std::vector<double> &reach)
{
  const double smallest = *std::min_element(reach.begin(), reach.end());
  std::vector<int> number(reach.size());
  for (std::size_t i = 0; i < reach.size(); ++i)
    number[i] = static_cast<int>(std::log2(reach[i] / smallest));
  return number;
}

/// Gap between the spheres, or between the radii along the branch [m].
double gap_between(const ParticleSystem &particles, ContactGeometry geometry,
                   const PairKey &pair)
{
  const auto i = static_cast<std::size_t>(pair.first),
             j = static_cast<std::size_t>(pair.second);
  const Vec3 branch = particles.branch(i, j);
  const double distance = branch.norm();
  const double spheres = distance - particles.radius(i) - particles.radius(j);
  if (!traits(geometry).reads_shape || distance == 0.)
    return spheres;
  const Vec3 normal = branch / distance;
  return distance - local_radius(particles, i, normal) -
         local_radius(particles, j, -normal);
}

/// How far two particles may have come nearer each other in all [m].
double path_length(const ParticleSystem &particles, const PairKey &pair,
                   const PathLengths &paths)
{
  return particles.has_shapes
             ? particles.path_length[static_cast<std::size_t>(pair.first)] +
                   particles
                       .path_length[static_cast<std::size_t>(pair.second)] +
                   paths.cell
             : paths.gaps;
}

/// All pairs whose bounding spheres come within `skin`. Particles are filed
/// by size: classes of a factor of two with a grid each, so that the cost per
/// particle does not grow with the ratio of sizes.
class PairSearch
{
public:
  PairSearch(const ParticleSystem &all, bool reads_shape, double gap)
      : particles(all), skin(gap), reach(reaches(all, reads_shape)),
        class_of(classify(reach))
  {
    classes.resize(static_cast<std::size_t>(
                       *std::max_element(class_of.begin(), class_of.end())) +
                   1);
    for (std::size_t i = 0; i < reach.size(); ++i)
    {
      SizeClass &own = classes[static_cast<std::size_t>(class_of[i])];
      own.particle.push_back(static_cast<std::int32_t>(i));
      own.largest = std::max(own.largest, reach[i]);
    }
    for (SizeClass &one : classes)
    {
      std::vector<Vec3> points;
      points.reserve(one.particle.size());
      for (const std::int32_t particle : one.particle)
        points.push_back(position_of(static_cast<std::size_t>(particle)));
      if (particles.cell.is_there())
        add_images(points, one.particle);
      one.grid = CellGrid(points, one.particle, one.largest + 0.5 * skin);
    }
  }

  /// Partners of particle i in its own class with a higher number and in the
  /// classes of larger particles.
  void find(std::size_t i, std::vector<PairKey> &pairs) const
  {
    const Vec3 x = position_of(i);
    const auto own = static_cast<std::size_t>(class_of[i]);
    for (std::size_t c = own; c < classes.size(); ++c)
    {
      const double range = reach[i] + classes[c].largest + skin;
      const Vec3 box = Vec3::Constant(range);
      classes[c].grid.visit_box(
          x - box, x + box,
          [&](std::int32_t other, const Vec3 &position)
          {
            const auto j = static_cast<std::size_t>(other);
            if ((c == own && j <= i) || !is_near(i, j, position - x))
              return;
            // Pairs of other juniors are found by the ranks that own them.
            const PairKey pair = juniors_first(i, j);
            if (static_cast<std::size_t>(pair.first) < particles.n_owned())
              pairs.push_back(pair);
          });
    }
  }

private:
  /// Inside of a periodic cell.
  Vec3 position_of(std::size_t particle) const
  {
    const Vec3 &x = particles.position(particle);
    return particles.cell.is_there() ? particles.cell.wrapped(x) : x;
  }

  /// Adds the images beyond the faces that particles inside may meet.
  void add_images(std::vector<Vec3> &points,
                  std::vector<std::int32_t> &numbers) const
  {
    const PeriodicCell &cell = particles.cell;
    const double range =
        2. * *std::max_element(reach.begin(), reach.end()) + skin;
    for (int d = 0; d < 3; ++d)
    {
      if (!cell.is_periodic(d))
        continue;
      require_unique_images(range, cell.length[d]);
      const double half = 0.5 * cell.length[d];
      // Images along the axes before have images, too.
      for (std::size_t k = 0, n = points.size(); k < n; ++k)
        for (const double side : {-1., 1.})
        {
          Vec3 image = points[k];
          image[d] += side * cell.length[d];
          if (std::abs(image[d] - cell.centre[d]) > half + range)
            continue;
          points.push_back(image);
          numbers.push_back(numbers[k]);
        }
    }
  }

  static void require_unique_images(double range, double length)
  {
    if (2. * range <= length)
      return;
    char text[160];
    std::snprintf(text, sizeof text,
                  "a periodic cell of %.4g m is too short: particles may reach "
                  "%.4g m and must not meet two images of one another",
                  length, range);
    throw std::runtime_error(text);
  }

  PairKey juniors_first(std::size_t i, std::size_t j) const
  {
    const auto a = static_cast<std::int32_t>(i),
               b = static_cast<std::int32_t>(j);
    return particles.is_junior(i, j) ? PairKey(a, b) : PairKey(b, a);
  }

  bool is_near(std::size_t i, std::size_t j, const Vec3 &branch) const
  {
    const double range = reach[i] + reach[j] + skin;
    return branch.squaredNorm() < range * range;
  }

  const ParticleSystem &particles;
  double skin;
  std::vector<double> reach;
  std::vector<int> class_of;
  std::vector<SizeClass> classes;
};

/// Sorts by first, then by second: a counting sort of short rows.
std::vector<PairKey> sorted(const std::vector<std::vector<PairKey>> &parts,
                            std::size_t n_particles)
{
  std::vector<std::int32_t> start(n_particles + 1, 0);
  for (const auto &part : parts)
    for (const PairKey &pair : part)
      ++start[static_cast<std::size_t>(pair.first) + 1];
  for (std::size_t i = 0; i < n_particles; ++i)
    start[i + 1] += start[i];
  std::vector<PairKey> all(static_cast<std::size_t>(start.back()));
  std::vector<std::int32_t> next(start.begin(), start.end() - 1);
  for (const auto &part : parts)
    for (const PairKey &pair : part)
      all[static_cast<std::size_t>(
          next[static_cast<std::size_t>(pair.first)]++)] = pair;
  for (std::size_t i = 0; i < n_particles; ++i)
    std::sort(all.begin() + start[i], all.begin() + start[i + 1]);
  return all;
}

/// All pairs whose circumscribed spheres, or equivalent ones where shapes are
/// not read, come within a range, sorted.
std::vector<PairKey> within(const ParticleSystem &particles, bool reads_shape,
                            double range)
{
  if (particles.size() == 0)
    return {};
  const PairSearch grids(particles, reads_shape, range);
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

std::vector<PairKey> PairFinder::find(const ParticleSystem &particles,
                                      ContactGeometry geometry, double skin,
                                      const PathLengths &paths)
{
  if (particles.size() == 0)
    return {};
  if (needs_search(skin, paths))
    search(particles, geometry, skin, paths);
  constexpr std::size_t part_size = 4096;
  std::vector<std::vector<PairKey>> parts((candidates.size() + part_size - 1) /
                                          part_size);
#pragma omp parallel for schedule(dynamic)
  for (std::size_t p = 0; p < parts.size(); ++p)
    for (std::size_t c = p * part_size;
         c < std::min(candidates.size(), (p + 1) * part_size); ++c)
    {
      Candidate &one = candidates[c];
      const double now = path_length(particles, one.particles, paths);
      if (one.least - now >= skin)
        continue;
      if (one.most + now >= skin)
      {
        const double gap = gap_between(particles, geometry, one.particles);
        one.least = gap + now;
        one.most = gap - now;
        if (gap >= skin)
          continue;
      }
      parts[p].push_back(one.particles);
    }
  std::vector<PairKey> pairs;
  for (const auto &part : parts)
    pairs.insert(pairs.end(), part.begin(), part.end());
  return pairs;
}

PairFinder::Candidate
PairFinder::between_spheres(const ParticleSystem &particles,
                            const PairKey &pair, double path_length)
{
  const auto i = static_cast<std::size_t>(pair.first),
             j = static_cast<std::size_t>(pair.second);
  const ParticleShape &a = particles.shape[i], &b = particles.shape[j];
  const double distance = particles.branch(i, j).norm();
  return {pair,
          distance - a.circumscribed_radius - b.circumscribed_radius +
              path_length,
          distance - a.least_radius - b.least_radius - path_length};
}

double PairFinder::search_range(const ParticleSystem &particles, double skin)
{
  // Wide enough for some rebuilds, narrow enough to be short: gaps of spheres
  // are had for less than the memory of their candidates.
  const double widening = particles.has_shapes ? 8. : 3.;
  return std::max(skin, std::min(widening * skin, widest_range(particles)));
}

void PairFinder::search(const ParticleSystem &particles,
                        ContactGeometry geometry, double skin,
                        const PathLengths &paths)
{
  const double range = search_range(particles, skin);
  // What is known of a pair still holds.
  const std::vector<Candidate> before = std::exchange(candidates, {});
  auto known = before.begin();
  const std::vector<PairKey> all =
      within(particles, traits(geometry).reads_shape, range);
  candidates.reserve(all.size());
  for (const PairKey &pair : all)
  {
    while (known != before.end() && known->particles < pair)
      ++known;
    candidates.push_back(
        known != before.end() && known->particles == pair
            ? *known
            : between_spheres(particles, pair,
                              path_length(particles, pair, paths)));
  }
  reach = paths.centres + range;
}

std::vector<std::uint8_t> PairFinder::named(std::size_t n_particles) const
{
  std::vector<std::uint8_t> is_named(n_particles, 0);
  for (const Candidate &one : candidates)
    is_named[static_cast<std::size_t>(one.particles.first)] =
        is_named[static_cast<std::size_t>(one.particles.second)] = 1;
  return is_named;
}

void PairFinder::renumber(const std::vector<std::int32_t> &new_row)
{
  for (Candidate &one : candidates)
    for (std::int32_t *row : {&one.particles.first, &one.particles.second})
      *row = new_row[static_cast<std::size_t>(*row)];
  std::ranges::sort(candidates, {}, &Candidate::particles);
}

double widest_range(const ParticleSystem &particles)
{
  double range = std::numeric_limits<double>::infinity();
  if (!particles.cell.is_there())
    return range;
  double bound = 0.;
  for (const ParticleShape &body : particles.shape)
    bound = std::max(bound, body.circumscribed_radius);
  for (int d = 0; d < 3; ++d)
    if (particles.cell.is_periodic(d))
      range = std::min(range, 0.5 * particles.cell.length[d] - 2. * bound);
  return range;
}

std::vector<PairKey> near_spheres(const ParticleSystem &particles, double skin)
{
  return within(particles, true, skin);
}
} // namespace dem
