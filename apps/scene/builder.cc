#include "scene/builder.h"

#include "case/digits.h"
#include "case/parameter.h"
#include "errors.h"
#include "specimen/mesh_walls.h"

#include <dem/engine_boundaries.h>
#include <dem/parallel/ranks.h>

#include <algorithm>
#include <limits>

namespace spall
{
namespace
{
constexpr std::array axis_names = {"x", "y", "z"};

std::array<BoxFaces, 3> faces_of(const SceneBoxParameters &box)
{
  return {box.x, box.y, box.z};
}

dem::EngineParameters engine_settings(const Case &parameters)
{
  const SceneCase &own = parameters.own<SceneCase>();
  dem::EngineParameters settings;
  settings.particle = parameters.particle;
  settings.other_solids = {own.other};
  settings.wall = settings.surface = parameters.wall;
  settings.geometry = parameters.contact;
  settings.friction_limit = parameters.friction_limit;
  settings.breakage = parameters.breakage;
  settings.local_damping = parameters.time.local_damping;
  settings.gravity = own.scene.gravity;
  return settings;
}

double smallest_radius(const PlacedParticles &particles)
{
  double smallest = std::numeric_limits<double>::infinity();
  for (const dem::ParticleShape &body : particles.body)
    smallest = std::min(smallest, dem::mean_radius(body));
  return smallest;
}

void add_particles(const PlacedParticles &from, dem::Engine &engine)
{
  for (std::size_t k = 0; k < from.body.size(); ++k)
    engine.add_particle(from.body[k], from.placement[k].position,
                        from.placement[k].orientation, from.material[k]);
  dem::ParticleSystem &particles = engine.particles();
  for (std::size_t row = 0; row < particles.size(); ++row)
  {
    const auto k = static_cast<std::size_t>(particles.id[row]);
    particles.velocity(row) = from.velocity[k];
    particles.spin(row) = from.spin[k];
  }
}

std::vector<BoxPlane> add_box(const SceneBoxParameters &box,
                              dem::Engine &engine)
{
  std::vector<BoxPlane> planes;
  const auto faces = faces_of(box);
  dem::Vec3 period = dem::Vec3::Zero();
  for (std::size_t d = 0; d < 3; ++d)
  {
    const auto axis = static_cast<Eigen::Index>(d);
    if (faces[d] == BoxFaces::periodic)
      period[axis] = box.upper[axis] - box.lower[axis];
    if (faces[d] != BoxFaces::rigid)
      continue;
    const dem::Vec3 inward = dem::Vec3::Unit(axis);
    planes.push_back({std::string(axis_names[d]) + "_min",
                      dem::add_plane(engine, box.lower, inward)});
    planes.push_back({std::string(axis_names[d]) + "_max",
                      dem::add_plane(engine, box.upper, -inward)});
  }
  if (!period.isZero())
    engine.set_periodic_cell(0.5 * (box.lower + box.upper), period);
  return planes;
}

/// The deepest contact of a batch over the radius of its smaller particle.
struct Deepest
{
  double ratio = 0.;
  std::string a, b;
};

void note_overlaps(const dem::ParticleSystem &all,
                   const dem::ContactBatch &batch,
                   const std::function<std::string(std::size_t)> &other,
                   bool is_pair, const PlacedParticles &particles,
                   Deepest &deepest)
{
  for (std::size_t k = 0; k < batch.size(); ++k)
  {
    const auto a = static_cast<std::size_t>(batch.a[k]);
    double radius = all.radius(a);
    if (is_pair)
      radius =
          std::min(radius, all.radius(static_cast<std::size_t>(batch.b[k])));
    const double ratio = batch.overlap[k] / radius;
    if (ratio > deepest.ratio)
      deepest = {ratio, particles.name[static_cast<std::size_t>(all.id[a])],
                 other(k)};
  }
}

/// Of all contacts of a scene.
Deepest deepest_of(const dem::Engine &engine, const PlacedParticles &particles)
{
  const dem::ParticleSystem &all = engine.particles();
  Deepest deepest;
  note_overlaps(
      all, engine.pairs(),
      [&](std::size_t k)
      {
        const auto b = static_cast<std::size_t>(engine.pairs().b[k]);
        return particles.name[static_cast<std::size_t>(all.id[b])];
      },
      true, particles, deepest);
  for (const auto &boundary : engine.boundaries())
    note_overlaps(
        all, boundary->batch,
        [&](std::size_t k) { return boundary->name_of(k); }, false, particles,
        deepest);
  return deepest;
}

dem::StepLimit step_limit(const Case &parameters, const dem::Engine &engine)
{
  dem::EngineParameters on = engine.parameters();
  dem::StepLimit limit = dem::critical_step(on, engine.particles());
  for (const WallSection &wall : parameters.walls)
  {
    on.surface = wall.material;
    const dem::StepLimit its = dem::critical_step(
        on, engine.particles(),
        "the wall (" + wall.section() + "/normal_stiffness)");
    if (its.step < limit.step)
      limit = its;
  }
  return limit;
}
} // namespace

BuiltScene build_scene(const Case &parameters, const PlacedParticles &particles,
                       std::shared_ptr<dem::Ranks> ranks)
{
  dem::EngineParameters settings = engine_settings(parameters);
  settings.geometry.usual_skin = 0.25 * smallest_radius(particles);
  BuiltScene built;
  built.engine = std::make_unique<dem::Engine>(settings, std::move(ranks));
  add_particles(particles, *built.engine);
  built.box = add_box(parameters.own<SceneCase>().box, *built.engine);
  add_mesh_walls(*built.engine, parameters);
  built.engine->set_breaking(false);
  return built;
}

dem::StepLimit check_as_placed(const Case &parameters,
                               const PlacedParticles &particles)
{
  Case any_depth = parameters;
  any_depth.contact.overlap.stop = std::numeric_limits<double>::max();
  const BuiltScene built = build_scene(any_depth, particles, dem::one_rank());
  built.engine->evaluate(1e-12);
  const Deepest deepest = deepest_of(*built.engine, particles);
  const double most = parameters.own<SceneCase>().scene.largest_overlap;
  if (deepest.ratio > most)
    throw InputError(deepest.a + ": overlaps " + deepest.b + " by " +
                     in_four_digits(deepest.ratio) +
                     " of its radius as placed: must be at most "
                     "Scene/largest_overlap = " +
                     number_text(most));
  return step_limit(parameters, *built.engine);
}
} // namespace spall
