#include <dem/measure/boundary_profile.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace dem
{
namespace
{
using Vec2 = Eigen::Vector2d;
using Side = Outline::Side;

double distance_to(const Side &side, const Vec2 &x)
{
  const Vec2 along = side[1] - side[0];
  const double square = along.squaredNorm();
  const double share =
      square > 0. ? std::clamp((x - side[0]).dot(along) / square, 0., 1.) : 0.;
  return (x - side[0] - share * along).norm();
}

/// Whether the ray from x along +x crosses the side.
bool is_crossed(const Side &side, const Vec2 &x)
{
  const auto &[p, q] = side;
  if ((p.y() > x.y()) == (q.y() > x.y()))
    return false;
  return x.x() < p.x() + (x.y() - p.y()) / (q.y() - p.y()) * (q.x() - p.x());
}

/// Distance to the sides of a section, negative outside [m].
double depth_in(const std::vector<Side> &section, const Vec2 &x)
{
  double least = std::numeric_limits<double>::infinity();
  bool is_inside = false;
  for (const Side &side : section)
  {
    least = std::min(least, distance_to(side, x));
    is_inside ^= is_crossed(side, x);
  }
  return is_inside ? least : -least;
}

/// Points, one in each cell of a grid round the outline; spread in their cells,
/// so that no layer of them lies along a wall.
class PointGrid
{
public:
  explicit PointGrid(const Outline &outline)
      : low(outline.low), n_z(outline.sections.size()),
        step_z((outline.high - outline.low) / static_cast<double>(n_z))
  {
    corner.setConstant(std::numeric_limits<double>::infinity());
    Vec2 upper = -corner;
    for (const std::vector<Side> &section : outline.sections)
      for (const Side &side : section)
      {
        corner = corner.cwiseMin(side[0]);
        upper = upper.cwiseMax(side[0]);
      }
    for (int d = 0; d < 2; ++d)
      n[static_cast<std::size_t>(d)] = static_cast<std::size_t>(
          std::max(1., std::ceil((upper - corner)[d] / step_z)));
    step = {(upper - corner).x() / static_cast<double>(n[0]),
            (upper - corner).y() / static_cast<double>(n[1])};
  }

  std::size_t size() const { return n_z * n[1] * n[0]; }
  std::size_t index(std::size_t i, std::size_t j, std::size_t k) const
  {
    return (k * n[1] + j) * n[0] + i;
  }
  Vec3 point(std::size_t i, std::size_t j, std::size_t k) const
  {
    // Multiples of the generalised golden ratio (Roberts 2018) are even.
    const auto spread = [](std::size_t one, std::size_t other)
    {
      const double sum = 0.7548776662466927 * static_cast<double>(one) +
                         0.5698402909980532 * static_cast<double>(other);
      return sum - std::floor(sum);
    };
    return {corner.x() + (static_cast<double>(i) + spread(j, k)) * step.x(),
            corner.y() + (static_cast<double>(j) + spread(i, k)) * step.y(),
            low + (static_cast<double>(k) + 0.5) * step_z};
  }

  /// Calls call(i, j, k) for all cells that may have their point within `reach`
  /// of x.
  template <class Call>
  void for_near(const Vec3 &x, double reach, const Call &call) const
  {
    const auto range =
        [reach](double at, double from, double cell, std::size_t count)
    {
      const auto clamped = [count](double value)
      {
        return static_cast<std::size_t>(
            std::clamp(value, 0., static_cast<double>(count)));
      };
      return std::pair(clamped(std::floor((at - reach - from) / cell)),
                       clamped(std::ceil((at + reach - from) / cell)));
    };
    const auto in_x = range(x.x(), corner.x(), step.x(), n[0]),
               in_y = range(x.y(), corner.y(), step.y(), n[1]),
               in_z = range(x.z(), low, step_z, n_z);
    for (std::size_t k = in_z.first; k < in_z.second; ++k)
      for (std::size_t j = in_y.first; j < in_y.second; ++j)
        for (std::size_t i = in_x.first; i < in_x.second; ++i)
          call(i, j, k);
  }

  std::array<std::size_t, 3> counts() const { return {n[0], n[1], n_z}; }
  double height_of_cell() const { return step_z; }
  double least_width() const ///< of the box round the sections [m]
  {
    return std::min(static_cast<double>(n[0]) * step.x(),
                    static_cast<double>(n[1]) * step.y());
  }

private:
  double low;
  std::size_t n_z;
  double step_z;
  Vec2 corner, step;
  std::array<std::size_t, 2> n{};
};

/// Calls call(centre) for the particle and its images in a periodic cell next
/// to that in which it is.
template <class Call>
void for_images(const PeriodicCell &cell, const Vec3 &centre, const Call &call)
{
  if (!cell.is_there())
    return call(centre);
  const Vec3 inside = cell.wrapped(centre);
  std::array<int, 3> reach;
  for (int d = 0; d < 3; ++d)
    reach[static_cast<std::size_t>(d)] = cell.is_periodic(d) ? 1 : 0;
  for (int i = -reach[0]; i <= reach[0]; ++i)
    for (int j = -reach[1]; j <= reach[1]; ++j)
      for (int k = -reach[2]; k <= reach[2]; ++k)
        call(Vec3(inside + cell.length.cwiseProduct(Vec3(i, j, k))));
}

/// Which points of the grid are in particles.
std::vector<std::uint8_t> solid_points(const ParticleSystem &particles,
                                       const PointGrid &grid)
{
  std::vector<std::uint8_t> is_solid(grid.size(), 0);
  for (std::size_t s = 0; s < particles.size(); ++s)
  {
    const ParticleShape &body = particles.shape[s];
    const Mat3 back = particles.rotation(s).transpose();
    const auto holds = [&](const Vec3 &arm)
    {
      const double square = arm.squaredNorm();
      if (square < std::pow(std::max(0., body.least_radius), 2))
        return true;
      if (!body.series || square > std::pow(body.circumscribed_radius, 2))
        return !body.series && square <= std::pow(mean_radius(body), 2);
      const double distance = std::sqrt(square);
      return distance <=
             body.scale * radius(*body.series, back * arm / distance);
    };
    for_images(particles.cell, particles.position(s),
               [&](const Vec3 &centre)
               {
                 grid.for_near(
                     centre, body.circumscribed_radius,
                     [&](std::size_t i, std::size_t j, std::size_t k)
                     {
                       std::uint8_t &entry = is_solid[grid.index(i, j, k)];
                       if (!entry && holds(grid.point(i, j, k) - centre))
                         entry = 1;
                     });
               });
  }
  return is_solid;
}

/// How far a point is from the boundaries [m].
struct Depth
{
  double lateral = 0., platen = 0.;

  bool is_inside() const { return lateral >= 0. && platen >= 0.; }
};

Depth depth_of(const Outline &outline, const Vec3 &x)
{
  const auto n = static_cast<double>(outline.sections.size());
  const double layer =
      std::floor((x.z() - outline.low) / (outline.high - outline.low) * n);
  const auto section = static_cast<std::size_t>(std::clamp(layer, 0., n - 1.));
  return {depth_in(outline.sections[section], x.head<2>()),
          std::min(x.z() - outline.low, outline.high - x.z())};
}

/// NaN of nothing.
double share(std::int64_t part, std::int64_t whole)
{
  return whole > 0 ? static_cast<double>(part) / static_cast<double>(whole)
                   : std::numeric_limits<double>::quiet_NaN();
}

/// Points of some part of the space.
struct Tally
{
  std::int64_t n = 0, n_solid = 0;

  void add(bool is_solid)
  {
    ++n;
    n_solid += is_solid;
  }
  double porosity() const ///< NaN without points
  {
    return 1. - share(n_solid, n);
  }
};

/// Particles and the contacts of those that bear (two or more).
struct ParticleTally
{
  std::int64_t n = 0, n_bearing = 0, n_contacts = 0;

  void add(int its_contacts)
  {
    ++n;
    if (its_contacts < 2)
      return;
    ++n_bearing;
    n_contacts += its_contacts;
  }
  double coordination() const { return share(n_contacts, n_bearing); }
};

/// Sums over the layers along one distance.
struct Layers
{
  double thickness;
  std::vector<Tally> points;
  std::vector<ParticleTally> particles;

  Layers(double each, double reach)
      : thickness(each),
        points(static_cast<std::size_t>(std::ceil(reach / each))),
        particles(points.size())
  {
  }
  std::size_t at(double distance) const
  {
    return std::min(static_cast<std::size_t>(distance / thickness),
                    points.size() - 1);
  }
  LayerProfile profile() const
  {
    LayerProfile profile;
    for (std::size_t k = 0; k < points.size(); ++k)
    {
      profile.distance.push_back((static_cast<double>(k) + 0.5) * thickness);
      profile.porosity.push_back(points[k].porosity());
      profile.coordination.push_back(particles[k].coordination());
      profile.n_particles.push_back(static_cast<double>(particles[k].n));
    }
    return profile;
  }
};

std::vector<int> contacts_of_particles(const ParticleSystem &particles,
                                       const Network &network)
{
  std::vector<int> n_of(particles.size(), 0);
  for (const PairContact &contact : network.pairs)
  {
    ++n_of[static_cast<std::size_t>(contact.a)];
    ++n_of[static_cast<std::size_t>(contact.b)];
  }
  return n_of;
}
} // namespace

BoundaryProfile boundary_profile(const ParticleSystem &particles,
                                 const Network &network, const Outline &outline,
                                 const ProfileWidths &widths)
{
  const PointGrid grid(outline);
  const std::vector<std::uint8_t> is_solid = solid_points(particles, grid);
  const double cell = grid.height_of_cell();
  const double layer = cell * std::max(1., std::round(widths.layer / cell));
  const auto [n_x, n_y, n_z] = grid.counts();
  Layers lateral(layer, 0.5 * grid.least_width()),
      platens(layer, 0.5 * (outline.high - outline.low));
  Tally all, skin, inside;
  for (std::size_t k = 0; k < n_z; ++k)
    for (std::size_t j = 0; j < n_y; ++j)
      for (std::size_t i = 0; i < n_x; ++i)
      {
        const Depth depth = depth_of(outline, grid.point(i, j, k));
        if (!depth.is_inside())
          continue;
        const bool holds = is_solid[grid.index(i, j, k)] != 0;
        all.add(holds);
        if (depth.platen >= widths.skin)
        {
          lateral.points[lateral.at(depth.lateral)].add(holds);
          (depth.lateral < widths.skin ? skin : inside).add(holds);
        }
        if (depth.lateral >= widths.skin)
          platens.points[platens.at(depth.platen)].add(holds);
      }
  ParticleTally particles_skin, particles_inside;
  const std::vector<int> n_of = contacts_of_particles(particles, network);
  for (std::size_t s = 0; s < particles.size(); ++s)
  {
    const Vec3 &centre = particles.position(s);
    const Depth depth = depth_of(outline, particles.cell.is_there()
                                              ? particles.cell.wrapped(centre)
                                              : centre);
    if (!depth.is_inside())
      continue;
    if (depth.platen >= widths.skin)
    {
      lateral.particles[lateral.at(depth.lateral)].add(n_of[s]);
      (depth.lateral < widths.skin ? particles_skin : particles_inside)
          .add(n_of[s]);
    }
    if (depth.lateral >= widths.skin)
      platens.particles[platens.at(depth.platen)].add(n_of[s]);
  }
  return {lateral.profile(),
          platens.profile(),
          all.porosity(),
          skin.porosity(),
          inside.porosity(),
          particles_skin.coordination(),
          particles_inside.coordination()};
}
} // namespace dem
