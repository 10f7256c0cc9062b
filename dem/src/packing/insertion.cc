#include <dem/neighbor/contact_points.h>
#include <dem/packing/insertion.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <stdexcept>
#include <string>

namespace dem
{
namespace
{
/// Reach of a placed particle towards a world direction, its sphere included
/// [m].
double reach(const ParticleShape &body, const Placement &placement,
             const Vec3 &direction)
{
  const double sphere = mean_radius(body);
  if (!body.series)
    return sphere;
  const Vec3 u = placement.orientation.conjugate() * direction;
  return std::max(sphere, body.scale * radius(*body.series, u.normalized()));
}

/// Particles placed so far, filed by cell.
class Cells
{
public:
  Cells(const Vec3 &lower, const Vec3 &upper, double cell_size)
      : origin(lower), size(cell_size)
  {
    for (std::size_t d = 0; d < 3; ++d)
      n[d] = std::max(1, static_cast<int>((upper[static_cast<int>(d)] -
                                           lower[static_cast<int>(d)]) /
                                          size));
    size = 0.;
    for (std::size_t d = 0; d < 3; ++d)
      size = std::max(
          size,
          (upper[static_cast<int>(d)] - lower[static_cast<int>(d)]) / n[d]);
    members.resize(static_cast<std::size_t>(n[0]) * n[1] * n[2]);
  }

  void add(const Vec3 &x, std::size_t particle)
  {
    members[index(cell(x))].push_back(particle);
  }

  /// True if `is_free` holds for every particle of the 27 cells round x.
  template <class Test>
  bool all_near(const Vec3 &x, const Test &is_free) const
  {
    const auto c = cell(x);
    for (int dz = -1; dz <= 1; ++dz)
      for (int dy = -1; dy <= 1; ++dy)
        for (int dx = -1; dx <= 1; ++dx)
        {
          const std::array<int, 3> near = {c[0] + dx, c[1] + dy, c[2] + dz};
          if (!is_inside(near))
            continue;
          for (const std::size_t particle : members[index(near)])
            if (!is_free(particle))
              return false;
        }
    return true;
  }

private:
  std::array<int, 3> cell(const Vec3 &x) const
  {
    std::array<int, 3> c;
    for (std::size_t d = 0; d < 3; ++d)
      c[d] = std::clamp(
          static_cast<int>(
              (x[static_cast<int>(d)] - origin[static_cast<int>(d)]) / size),
          0, n[d] - 1);
    return c;
  }
  bool is_inside(const std::array<int, 3> &c) const
  {
    for (std::size_t d = 0; d < 3; ++d)
      if (c[d] < 0 || c[d] >= n[d])
        return false;
    return true;
  }
  std::size_t index(const std::array<int, 3> &c) const
  {
    return (static_cast<std::size_t>(c[2]) * n[1] + c[1]) * n[0] + c[0];
  }

  Vec3 origin;
  double size;
  std::array<int, 3> n{};
  std::vector<std::vector<std::size_t>> members;
};

bool fits_cylinder(const ParticleShape &body, const Placement &placement,
                   const InsertionBox &box)
{
  const Vec3 middle = 0.5 * (box.lower + box.upper);
  const double from_axis = (placement.position - middle).head<2>().norm();
  return from_axis + body.circumscribed_radius <=
         0.5 * (box.upper.x() - box.lower.x());
}

bool fits_box(const ParticleShape &body, const Placement &placement,
              const InsertionBox &box)
{
  for (int d = 0; d < 3; ++d)
  {
    const Vec3 axis = Vec3::Unit(d);
    const double down = box.sees_surfaces ? body.circumscribed_radius
                                          : reach(body, placement, -axis);
    const double up = box.sees_surfaces ? body.circumscribed_radius
                                        : reach(body, placement, axis);
    if (placement.position[d] - box.lower[d] < down ||
        box.upper[d] - placement.position[d] < up)
      return false;
  }
  return !box.is_round || fits_cylinder(body, placement, box);
}

/// Particles and where they are so far.
class PlacedParticles
{
public:
  PlacedParticles(std::span<const ParticleShape> bodies, bool surfaces)
      : particles(bodies), sees_surfaces(surfaces)
  {
    for (const ParticleShape &body : particles)
      if (sees_surfaces && !maps.contains(body.series.get()))
        maps.try_emplace(body.series.get(), body.series);
  }

  /// Whether the next particle overlaps none that is there.
  bool is_free(std::size_t j, const Placement &placement) const
  {
    const std::size_t i = placements.size();
    const Vec3 branch = placements[j].position - placement.position;
    const double distance = branch.norm();
    if (distance >
        particles[i].circumscribed_radius + particles[j].circumscribed_radius)
      return true;
    const Vec3 u = branch / distance;
    if (distance <= reach(particles[i], placement, u) +
                        reach(particles[j], placements[j], -u))
      return false;
    return !sees_surfaces || !overlaps(i, placement, j);
  }

  std::vector<Placement> placements;

private:
  bool overlaps(std::size_t i, const Placement &placement, std::size_t j) const
  {
    const Quaternion to_own = placement.orientation.conjugate();
    const RelativePose pose{
        to_own * (placements[j].position - placement.position),
        (to_own * placements[j].orientation).toRotationMatrix()};
    // The nodes of the maps miss the nearest point by a little.
    const double margin =
        0.05 * std::min(mean_radius(particles[i]), mean_radius(particles[j]));
    return may_touch({{particles[i], maps.at(particles[i].series.get())},
                      {particles[j], maps.at(particles[j].series.get())},
                      pose},
                     margin);
  }

  std::span<const ParticleShape> particles;
  bool sees_surfaces;
  std::map<const Coefficients *, RadiusMap> maps; ///< by series
};
} // namespace

std::vector<Placement>
insert_particles(std::span<const ParticleShape> particles,
                 const InsertionBox &box, Random &random)
{
  constexpr int n_tries = 20000;
  double largest = 0.;
  for (const ParticleShape &body : particles)
    largest = std::max(largest, body.circumscribed_radius);
  Cells cells(box.lower, box.upper, 2. * largest);
  PlacedParticles placed(particles, box.sees_surfaces);
  for (std::size_t i = 0; i < particles.size(); ++i)
  {
    Placement placement;
    const auto is_free = [&](std::size_t j)
    { return placed.is_free(j, placement); };
    int tries = 0;
    do
    {
      if (++tries > n_tries)
        throw NoFreePosition(
            "no free position for particle " + std::to_string(i + 1) + " of " +
            std::to_string(particles.size()) + " in the random cloud");
      for (int d = 0; d < 3; ++d)
        placement.position[d] =
            std::lerp(box.lower[d], box.upper[d], random.uniform());
      placement.orientation = random.rotation();
    } while (
        !fits_box(particles[i], placement, box) ||
        (box.is_clear && !box.is_clear(placement.position,
                                       particles[i].circumscribed_radius)) ||
        !cells.all_near(placement.position, is_free));
    placed.placements.push_back(placement);
    cells.add(placement.position, i);
  }
  return placed.placements;
}
} // namespace dem
