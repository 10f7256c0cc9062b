// Time per contact with a wall and step, surfaces over balls, in one run: the
// table of docs/verification/surfaces.md.
//
//   surface_walls_cost
#include "wall_meshes.h"

#include <dem/engine_boundaries.h>
#include <dem/random.h>

#include <cstdio>
#include <ctime>
#include <memory>
#include <shape/test_shapes.h>

namespace
{
using dem::Vec3;

enum class Wall
{
  none,
  plane,
  flat_mesh,
  rough_mesh,
  cylinder
};

constexpr int n_side = 14;
constexpr double radius = 0.01, spacing = 0.028, time_step = 2e-6;

dem::EngineParameters parameters(bool is_surface)
{
  dem::EngineParameters p;
  p.geometry.geometry = p.geometry.wall_geometry =
      is_surface ? dem::ContactGeometry::surface : dem::ContactGeometry::sphere;
  p.wall.normal_stiffness = 1e6;
  p.wall.shear_stiffness = 0.85e6;
  p.surface = p.wall;
  p.breakage.is_active = false;
  p.local_damping = 0.2;
  p.gravity = {0., 0., -9.81};
  p.geometry.usual_skin = 0.25 * radius;
  return p;
}

/// Particles that lie on the wall apart from each other, at rest.
dem::Engine rested(Wall wall, bool is_surface)
{
  dem::Engine engine(parameters(is_surface));
  const auto series = std::make_shared<const dem::Coefficients>(
      dem::test::random_particle(14, 8));
  const dem::ParticleShape body = dem::make_shape(series, radius);
  dem::Random random(1);
  constexpr double far = 3.;
  for (int i = 0; i < n_side; ++i)
    for (int j = 0; j < n_side; ++j)
    {
      const double x = (i - 0.5 * n_side) * spacing,
                   y = (j - 0.5 * n_side) * spacing;
      const double floor =
          wall == Wall::cylinder ? far - std::sqrt(far * far - x * x) : 0.;
      engine.add_particle(body, {x, y, floor + 1.25 * radius},
                          random.rotation());
    }
  if (wall == Wall::plane)
    dem::add_plane(engine, Vec3::Zero(), Vec3::UnitZ());
  if (wall == Wall::flat_mesh || wall == Wall::rough_mesh)
    dem::attach_surface(
        engine,
        support::flat_floor(0.02, 26, wall == Wall::rough_mesh ? 0.1 : 0.));
  if (wall == Wall::cylinder)
  {
    dem::Drum drum;
    drum.centre = {0., 0., far};
    drum.radius = far;
    drum.length = 4.;
    dem::set_drum(engine, drum);
  }
  const int settling = wall == Wall::none ? 100 : 40000;
  for (int step = 0; step < settling; ++step)
    engine.advance(time_step);
  return engine;
}

const dem::ContactBatch &contacts(const dem::Engine &engine, Wall wall)
{
  return wall == Wall::plane      ? dem::on_planes(engine)
         : wall == Wall::cylinder ? dem::on_drum(engine)
                                  : dem::on_facets(engine);
}

int touching(const dem::ContactBatch &batch)
{
  int n = 0;
  for (std::size_t k = 0; k < batch.size(); ++k)
    n += batch.is_touching(k);
  return n;
}

double processor_time()
{
  return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

/// Processor time of a step, the least of some tries [s].
double step_time(dem::Engine &engine)
{
  constexpr int n_steps = 1000, n_tries = 7;
  double best = 1e9;
  for (int attempt = 0; attempt < n_tries; ++attempt)
  {
    const double before = processor_time();
    for (int step = 0; step < n_steps; ++step)
      engine.advance(time_step);
    best = std::min(best, (processor_time() - before) / n_steps);
  }
  return best;
}

struct Cost
{
  double nanoseconds = 0.; ///< per touching contact and step
  double contacts = 0.;    ///< that touch, per particle
};

/// Over the time of a step without walls.
Cost measure(Wall wall, bool is_surface, double free)
{
  dem::Engine engine = rested(wall, is_surface);
  const double time = step_time(engine) - free;
  const double n = touching(contacts(engine, wall));
  return {1e9 * time / n, n / (n_side * n_side)};
}
} // namespace

int main()
{
  std::printf(
      "| wall | ball: ns per contact and step | touching per particle | "
      "surface: ns | touching per particle | surface over ball |\n"
      "|---|---|---|---|---|---|\n");
  dem::Engine free_balls = rested(Wall::none, false),
              free_surfaces = rested(Wall::none, true);
  const double balls = step_time(free_balls),
               surfaces = step_time(free_surfaces);
  const char *name[] = {"none", "plane", "flat mesh", "rough mesh", "cylinder"};
  for (const Wall wall :
       {Wall::plane, Wall::flat_mesh, Wall::rough_mesh, Wall::cylinder})
  {
    const Cost ball = measure(wall, false, balls),
               surface = measure(wall, true, surfaces);
    std::printf("| %s | %.0f | %.2f | %.0f | %.2f | %.1f |\n",
                name[static_cast<int>(wall)], ball.nanoseconds, ball.contacts,
                surface.nanoseconds, surface.contacts,
                surface.nanoseconds / ball.nanoseconds);
    std::fflush(stdout);
  }
}
