#include <dem/measure/slice.h>
#include <dem/shape/cross_section.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <numbers>
#include <numeric>

namespace dem
{
namespace
{
/// Bodies that many particles share are prepared once.
class SharedBodies
{
public:
  const SectionedBody &of(const std::shared_ptr<const Coefficients> &series)
  {
    std::unique_ptr<SectionedBody> &body = known[series.get()];
    if (!body)
      body = std::make_unique<SectionedBody>(*series);
    return *body;
  }

private:
  std::map<const Coefficients *, std::unique_ptr<SectionedBody>> known;
};

void move(const Eigen::Vector2d &by, std::vector<Polygon> &polygons)
{
  for (Polygon &polygon : polygons)
    for (Eigen::Vector2d &corner : polygon)
      corner += by;
}

void simplify(double tolerance, std::vector<Polygon> &polygons)
{
  for (Polygon &polygon : polygons)
    polygon = simplified(polygon, tolerance);
}

/// One particle: cut at any height.
class CutParticle
{
public:
  CutParticle(const ParticleSystem &its_particles, std::size_t row,
              const FirstShape &its_first, SharedBodies &its_bodies)
      : particles(its_particles), i(row), first(its_first), bodies(its_bodies),
        shape(particles.shape[row])
  {
    is_broken = shape.series && shape.series != first.series && first.series;
  }

  /// Whether it, or its first shape, may reach a height [m].
  bool reaches(double z) const
  {
    const double reach =
        shape.series ? shape.circumscribed_radius : particles.radius(i);
    return std::abs(z - particles.position(i).z()) <
           (is_broken ? std::max(reach, first.reach) : reach);
  }

  /// The outline is empty where it does not reach the height [m].
  ParticleSection cut(double z, const SliceParameters &parameters)
  {
    ParticleSection section;
    section.particle = particles.id[i];
    const Vec3 &centre = particles.position(i);
    plane = {particles.rotation(i), z - centre.z()};
    if (!shape.series)
      cut_sphere(section);
    else if (is_broken)
      cut_broken(parameters, section);
    else
    {
      take_outline(bodies.of(shape.series).at_scale(shape.scale), section);
    }
    const double tolerance = parameters.tolerance * particles.radius(i);
    simplify(tolerance, section.outline);
    simplify(std::min(tolerance, 0.05 * section.depth), section.spalled);
    move(centre.head<2>(), section.outline);
    move(centre.head<2>(), section.spalled);
    return section;
  }

private:
  void cut_sphere(ParticleSection &section) const
  {
    const double r = particles.radius(i),
                 square = r * r - plane.height * plane.height;
    if (square <= 0.)
      return;
    section.outline = {
        circle_polygon(Eigen::Vector2d::Zero(), std::sqrt(square))};
    section.area = std::numbers::pi * square;
  }

  void take_outline(const SectionedBody &body, ParticleSection &section) const
  {
    for (SectionLoop &loop : body.section(plane))
    {
      section.area += loop.area;
      section.outline.push_back(std::move(loop.corners));
    }
  }

  /// Its series is its own: it is prepared for this particle alone.
  void cut_broken(const SliceParameters &parameters, ParticleSection &section)
  {
    if (!own)
      own = std::make_unique<SectionedBody>(*shape.series, shape.scale);
    take_outline(*own, section);
    LostRegions lost =
        lost_regions(bodies.of(first.series).at_scale(first.scale), *own, plane,
                     parameters.least_depth * particles.radius(i));
    section.lost_area = lost.area_before - section.area;
    section.spalled = std::move(lost.regions);
    section.depth = std::max(0., lost.depth);
  }

  const ParticleSystem &particles;
  std::size_t i;
  const FirstShape &first;
  SharedBodies &bodies;
  const ParticleShape &shape;
  std::unique_ptr<SectionedBody> own;
  SectionPlane plane;
  bool is_broken = false;
};
} // namespace

std::vector<FirstShape> first_shapes(const ParticleSystem &particles)
{
  std::vector<FirstShape> first(particles.size());
  for (std::size_t i = 0; i < particles.size(); ++i)
  {
    const ParticleShape &shape = particles.shape[i];
    first[static_cast<std::size_t>(particles.id[i])] = {
        shape.series, shape.scale, shape.circumscribed_radius};
  }
  return first;
}

std::vector<Slice> slices_at(const ParticleSystem &particles,
                             std::span<const FirstShape> first,
                             std::span<const double> heights,
                             const SliceParameters &parameters)
{
  std::vector<std::size_t> rows(particles.size());
  std::iota(rows.begin(), rows.end(), std::size_t{0});
  std::ranges::sort(rows, {},
                    [&](std::size_t row) { return particles.id[row]; });
  std::vector<Slice> slices;
  for (const double z : heights)
    slices.push_back({z, {}});
  SharedBodies bodies;
  for (const std::size_t row : rows)
  {
    CutParticle particle(particles, row,
                         first[static_cast<std::size_t>(particles.id[row])],
                         bodies);
    for (Slice &slice : slices)
      if (particle.reaches(slice.z))
        if (ParticleSection section = particle.cut(slice.z, parameters);
            !section.outline.empty() || !section.spalled.empty())
          slice.particles.push_back(std::move(section));
  }
  return slices;
}
} // namespace dem
