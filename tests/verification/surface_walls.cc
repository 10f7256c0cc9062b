// Where particles meet walls, against a brute force that knows nothing but the
// radius of the series: the table of docs/verification/surfaces.md.
//
//   surface_walls N SEED SHAPES [SHAPES ...]
#include "brute_force.h"
#include "wall_meshes.h"

#include <dem/boundary/wall_contact_points.h>
#include <dem/random.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <numeric>
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

/// A compass search for the least value of a function of n numbers.
template <std::size_t n, class Value>
double compass(std::array<double, n> &at, double step, const Value &value)
{
  double best = value(at);
  while (step > 1e-8)
  {
    bool is_better = false;
    for (std::size_t c = 0; c < n; ++c)
      for (const double sign : {1., -1.})
      {
        std::array<double, n> next = at;
        next[c] += sign * step;
        if (const double there = value(next); there < best)
        {
          best = there;
          at = next;
          is_better = true;
        }
      }
    if (!is_better)
      step *= 0.5;
  }
  return best;
}

/// A particle in the world, as the brute force sees it.
struct Solid
{
  const ParticleShape &body;
  Vec3 position;
  dem::Mat3 rotation;
  std::vector<Vec3> direction, point; ///< dense, in the body and the world

  Solid(const ParticleShape &of, const Vec3 &at, const dem::Mat3 &turned)
      : body(of), position(at), rotation(turned)
  {
    constexpr dem::DirectionGrid grid{48, 96};
    for (int node = 0; node < grid.size(); ++node)
    {
      direction.push_back(
          grid.direction(node / grid.n_azimuth, node % grid.n_azimuth));
      point.push_back(on_surface(direction.back()));
    }
  }

  Vec3 on_surface(const Vec3 &s) const
  {
    return position +
           rotation * Vec3(body.scale * dem::radius(*body.series, s) * s);
  }
  bool is_inside(const Vec3 &x) const
  {
    const Vec3 in_body = rotation.transpose() * (x - position);
    return in_body.norm() <
           body.scale * dem::radius(*body.series, in_body.normalized());
  }
  double coarse_depth(const Vec3 &x, std::size_t &node) const
  {
    double least = 1e300;
    for (std::size_t k = 0; k < point.size(); ++k)
      if (const double d = (point[k] - x).squaredNorm(); d < least)
      {
        least = d;
        node = k;
      }
    return (is_inside(x) ? 1. : -1.) * std::sqrt(least);
  }
  /// How deep a point is: its distance from the surface next to it.
  double depth(const Vec3 &x, Vec3 &from) const
  {
    const Vec3 first = from.unitOrthogonal(), second = from.cross(first);
    std::array<double, 2> turn{};
    const auto direction_at = [&](const std::array<double, 2> &t)
    { return (from + t[0] * first + t[1] * second).normalized(); };
    const double least =
        compass(turn, 0.02,
                [&](const std::array<double, 2> &t)
                { return (on_surface(direction_at(t)) - x).norm(); });
    from = direction_at(turn);
    return is_inside(x) ? least : -least;
  }
};

/// A piece of a wall over two numbers, each 0 .. 1.
struct Piece
{
  std::array<Vec3, 3> corner; ///< of a triangle
  double radius = 0.;         ///< of a cylinder about z; 0: a triangle

  Vec3 at(const std::array<double, 2> &t) const
  {
    if (radius > 0.)
      return {radius * std::cos(t[0] / radius),
              radius * std::sin(t[0] / radius), t[1]};
    // The square folded to the triangle.
    double u = std::clamp(t[0], 0., 1.), v = std::clamp(t[1], 0., 1.);
    const double over = u + v - 1.;
    if (over > 0.)
    {
      u -= 0.5 * over;
      v -= 0.5 * over;
    }
    u = std::clamp(u, 0., 1.);
    v = std::clamp(v, 0., 1. - u);
    return corner[0] + u * (corner[1] - corner[0]) +
           v * (corner[2] - corner[0]);
  }
};

struct Start
{
  double depth = 0.;
  std::size_t piece = 0, node = 0;
  std::array<double, 2> at{};
};

/// Points of all pieces about the particle, the deepest first.
std::vector<Start> starts(const Solid &particle,
                          const std::vector<Piece> &pieces, double spacing)
{
  std::vector<Start> all;
  const double reach = 1.1 * particle.body.circumscribed_radius;
  for (std::size_t p = 0; p < pieces.size(); ++p)
  {
    const Piece &piece = pieces[p];
    const auto add = [&](const std::array<double, 2> &t)
    {
      const Vec3 x = piece.at(t);
      if ((x - particle.position).norm() > reach)
        return;
      Start start;
      start.piece = p;
      start.at = t;
      start.depth = particle.coarse_depth(x, start.node);
      all.push_back(start);
    };
    if (piece.radius > 0.)
    {
      const double angle =
          std::atan2(particle.position.y(), particle.position.x()) *
          piece.radius;
      for (double a = -reach; a < reach; a += spacing)
        for (double z = -reach; z < reach; z += spacing)
          add({angle + a, particle.position.z() + z});
      continue;
    }
    const double size = std::max((piece.corner[1] - piece.corner[0]).norm(),
                                 (piece.corner[2] - piece.corner[0]).norm());
    const int n = std::clamp(static_cast<int>(size / spacing), 2, 60);
    for (int i = 0; i <= n; ++i)
      for (int j = 0; i + j <= n; ++j)
        add({double(i) / n, double(j) / n});
  }
  std::sort(all.begin(), all.end(),
            [](const Start &a, const Start &b) { return a.depth > b.depth; });
  return all;
}

/// The greatest depth of any point of the wall; below zero it is a gap.
double deepest(const Solid &particle, const std::vector<Piece> &pieces,
               double size)
{
  double best = -1e300;
  std::vector<Start> tried;
  for (const Start &start : starts(particle, pieces, 0.08 * size))
  {
    if (tried.size() >= 5)
      break;
    const auto is_beside = [&](const Start &other)
    {
      return other.piece == start.piece && (pieces[other.piece].at(other.at) -
                                            pieces[start.piece].at(start.at))
                                                   .norm() < 0.3 * size;
    };
    if (std::any_of(tried.begin(), tried.end(), is_beside))
      continue;
    tried.push_back(start);
    const Piece &piece = pieces[start.piece];
    const double scale =
        piece.radius > 0. ? 1. : (piece.corner[1] - piece.corner[0]).norm();
    std::array<double, 2> at = start.at;
    Vec3 from = particle.direction[start.node];
    best = std::max(best, -compass(at, 0.05 * size / scale,
                                   [&](const std::array<double, 2> &t)
                                   {
                                     Vec3 next = from;
                                     return -particle.depth(piece.at(t), next);
                                   }));
  }
  return best;
}

/// A wall, a point above it and the way to it.
struct Scene
{
  const char *name;
  support::WallMesh mesh; ///< empty: the cylinder
  dem::Drum drum;
  std::vector<Piece> pieces;

  bool is_cylinder() const { return mesh.surface.triangles.empty(); }
};

dem::WallSearchResult search(const Scene &scene,
                             const dem::MappedParticlePose &particle,
                             double margin)
{
  if (scene.is_cylinder())
    return dem::find_on_drum(particle, scene.drum, dem::DrumPart::cylinder,
                             margin);
  std::vector<std::int32_t> near;
  const double reach = particle.particle.body.circumscribed_radius + margin;
  for (std::int32_t t = 0; std::size_t(t) < scene.mesh.surface.triangles.size();
       ++t)
    if ((dem::nearest_point(particle.position,
                            dem::corners_of(scene.mesh.surface, t))
             .point -
         particle.position)
            .norm() < reach)
      near.push_back(t);
  return dem::find_on_facets(particle, scene.mesh.view(), near, margin);
}

Scene make_cylinder()
{
  Scene scene{"cylinder", {}, {}, {}};
  scene.drum.axis = Vec3::UnitZ();
  scene.drum.radius = 6.;
  scene.drum.length = 100.;
  scene.pieces.push_back({{}, 6.});
  return scene;
}

Scene make_scene(const char *name, support::WallMesh mesh)
{
  Scene scene{name, std::move(mesh), {}, {}};
  for (std::int32_t t = 0; std::size_t(t) < scene.mesh.surface.triangles.size();
       ++t)
    scene.pieces.push_back({dem::corners_of(scene.mesh.surface, t), 0.});
  return scene;
}

/// Down along `way` until the deepest overlap is as wanted, by the search.
void approach(const Scene &scene, dem::MappedParticlePose &particle,
              const Vec3 &way, double overlap)
{
  const double size = dem::mean_radius(particle.particle.body);
  for (int step = 0; step < 600; ++step)
  {
    const dem::WallSearchResult found = search(scene, particle, 0.2 * size);
    const double now = found.contact_points.empty()
                           ? -0.2 * size
                           : found.contact_points.front().overlap;
    if (now > overlap - 1e-4 * size)
      return;
    particle.position += std::max(0.3 * (overlap - now), 1e-4 * size) * way;
  }
}

void compare(const Scene &scene, const dem::MappedParticlePose &particle,
             Tally &tally)
{
  const double size = dem::mean_radius(particle.particle.body);
  const double before = processor_time();
  const dem::WallSearchResult found = search(scene, particle, 0.02 * size);
  tally.seconds += processor_time() - before;
  tally.n_several += found.contact_points.size() > 1;
  const Solid solid(particle.particle.body, particle.position,
                    particle.rotation);
  const double overlap = found.contact_points.empty()
                             ? -1e3
                             : found.contact_points.front().overlap;
  tally.add(deepest(solid, scene.pieces, size) / (2. * size),
            overlap / (2. * size));
}
} // namespace

int main(int argc, char **argv)
{
  if (argc < 4)
  {
    std::fprintf(stderr, "surface_walls N SEED SHAPES [SHAPES ...]\n");
    return 1;
  }
  std::vector<Particle> particles;
  for (int k = 3; k < argc; ++k)
    for (const spall::ShapeFile &shape : spall::read_shapes(argv[k]))
      particles.emplace_back(shape.coefficients);
  const std::vector<Scene> scenes = {
      make_cylinder(), make_scene("flat mesh", support::flat_wall(1.2, 8, 0.)),
      make_scene("inside of a box", support::box_corner(6.)),
      make_scene("steps", support::stepped_wall(1.1, 8)),
      make_scene("bulged mesh", support::flat_wall(1.2, 8, 0.35))};
  std::printf("| wall | number | search misses the deepest contact point | "
              "brute force misses "
              "it | worst error of the others over the diameter | more than "
              "one contact point "
              "| us per search |\n|---|---|---|---|---|---|---|\n");
  dem::Random random(std::stoull(argv[2]));
  for (const Scene &scene : scenes)
  {
    Tally tally;
    for (int k = 0; k < std::stoi(argv[1]); ++k)
    {
      const Particle &one = particles[static_cast<std::size_t>(
          random.uniform() * static_cast<double>(particles.size()))];
      const Vec3 aside(random.uniform() - 0.5, random.uniform() - 0.5, 0.);
      const bool is_corner = std::string(scene.name) == "inside of a box";
      dem::MappedParticlePose particle{
          {one.body, one.map}, {}, random.rotation().toRotationMatrix()};
      Vec3 way = -Vec3::UnitZ();
      if (scene.is_cylinder())
        way =
            (random.rotation() * Vec3::UnitX()).cwiseProduct(Vec3(1., 1., 0.));
      else if (is_corner)
        way = Vec3(-1. - 0.5 * random.uniform(), -1. - 0.5 * random.uniform(),
                   -1. - 0.5 * random.uniform());
      way.normalize();
      particle.position = scene.is_cylinder() ? Vec3(way)
                          : is_corner         ? Vec3(Vec3::Constant(3.) + aside)
                                      : Vec3(3. * aside + 2.5 * Vec3::UnitZ());
      const double overlap =
          (k % 2 == 0 ? -1. : 1.) * 0.01 * (0.05 + 0.95 * random.uniform());
      approach(scene, particle, way, overlap);
      compare(scene, particle, tally);
    }
    std::printf("| %s | %d | %d | %d | %.1e | %.1f %% | %.0f |\n", scene.name,
                tally.n, tally.n_missed, tally.n_beaten, tally.worst,
                100. * tally.n_several / std::max(1, tally.n),
                1e6 * tally.seconds / std::max(1, tally.n));
    std::fflush(stdout);
  }
}
