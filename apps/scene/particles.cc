// The particles of a scene: placed by the user, or drawn from a gradation.
#include "case/file.h"
#include "case/parameter.h"
#include "errors.h"
#include "scene/builder.h"
#include "shape/loaded.h"
#include "specimen/mesh_walls.h"
#include "specimen/obtained_gradation.h"

namespace spall
{
namespace
{
/// Loads the shapes of the filling; returns those alone.
ShapeLibrary filling_shapes(const Case &parameters, PlacedParticles &scene)
{
  const FillParameters &fill = parameters.own<SceneCase>().fill;
  ShapeLibrary own;
  if (fill.shapes.empty())
    return own;
  for (const ShapeFile &file :
       read_shapes(find_path(parameters, "Fill", "shapes", fill.shapes)))
  {
    own.add(load_with_warnings(file, fill.order), file);
    scene.shapes.add(own.back(), file);
  }
  return own;
}

void fill(const Case &parameters, PlacedParticles &scene)
{
  const FillParameters &fill = parameters.own<SceneCase>().fill;
  const ShapeLibrary shapes = filling_shapes(parameters, scene);
  dem::Random random(static_cast<std::uint64_t>(fill.seed));
  const std::vector<dem::ParticleShape> drawn = draw_particles(
      parameters, fill.mass / parameters.particle.density, shapes, random);
  if (drawn.empty())
    throw InputError(parameters.file +
                     ": Fill/mass = " + number_text(fill.mass) +
                     ": too small for a single particle of the gradation");
  std::vector<dem::Placement> placements;
  try
  {
    placements = dem::insert_particles(drawn,
                                       {fill.lower, fill.upper,
                                        parameters.contact.follows_surfaces(),
                                        false, clear_of_walls(parameters)},
                                       random);
  }
  catch (const dem::NoFreePosition &error)
  {
    throw InputError(parameters.file + ": " + error.what() +
                     ": Fill/mass = " + number_text(fill.mass) +
                     " kg must be lower, or the region from Fill/lower to "
                     "Fill/upper larger");
  }
  scene.add_at_rest(drawn, placements, "Fill");
}
} // namespace

PlacedParticles make_scene_particles(const Case &parameters)
{
  const SceneCase &own = parameters.own<SceneCase>();
  PlacedParticles scene;
  if (!own.scene.particles.empty())
    scene = place_particles(
        parameters, {"Scene", own.scene.particles, own.scene.shapes,
                     own.scene.order, "section Other, which does not break"});
  if (own.fill.mass > 0.)
    fill(parameters, scene);
  return scene;
}
} // namespace spall
