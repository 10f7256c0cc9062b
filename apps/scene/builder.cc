#include "scene/builder.h"

#include "specimen/mesh_walls.h"

#include <dem/engine_boundaries.h>
#include <dem/parallel/ranks.h>

#include <array>

namespace spall
{
namespace
{
constexpr std::array axis_names = {"x", "y", "z"};

std::array<BoxFaces, 3> faces_of(const SceneBoxParameters &box)
{
  return {box.x, box.y, box.z};
}

dem::EngineParameters engine_settings(const Case &parameters,
                                      const PlacedParticles &particles)
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
  settings.geometry.usual_skin = 0.25 * particles.smallest_radius();
  return settings;
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

} // namespace

BuiltScene build_scene(const Case &parameters, const PlacedParticles &particles,
                       std::shared_ptr<dem::Ranks> ranks)
{
  BuiltScene built;
  built.engine = std::make_unique<dem::Engine>(
      engine_settings(parameters, particles), std::move(ranks));
  add_particles(particles, *built.engine);
  built.box = add_box(parameters.own<SceneCase>().box, *built.engine);
  add_mesh_walls(*built.engine, parameters);
  built.engine->set_breaking(false);
  return built;
}

SceneStart check_scene_as_placed(const Case &parameters,
                                 const PlacedParticles &particles)
{
  const SceneCase &own = parameters.own<SceneCase>();
  const auto engine = check_as_placed(parameters, particles,
                                      {"Scene", own.scene.largest_overlap,
                                       engine_settings(parameters, particles),
                                       [&](dem::Engine &scene)
                                       {
                                         add_box(own.box, scene);
                                         add_mesh_walls(scene, parameters);
                                       }});
  const dem::EngineEnergy energy = engine->energy();
  return {limit_on_walls(
              parameters, engine->parameters(), engine->particles(),
              dem::critical_step(engine->parameters(), engine->particles())),
          energy.kinetic, energy.elastic};
}
} // namespace spall
