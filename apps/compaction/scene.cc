#include "compaction/scene.h"

#include "case/gravity.h"
#include "case/parameter.h"
#include "compaction/plate.h"
#include "errors.h"
#include "specimen/mesh_walls.h"
#include "specimen/obtained_gradation.h"
#include "specimen/placed_particles.h"
#include "test/test.h"

#include <coupling/triaxial_cell.h>
#include <dem/engine_boundaries.h>
#include <dem/parallel/mpi_ranks.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace spall
{
namespace
{
dem::Room room_of(const Case &parameters)
{
  const ContainerParameters &c = parameters.container;
  return c.has_mesh()
             ? room_in_mesh(parameters)
             : dem::Room{dem::Vec3::Zero(), c.diameter, c.diameter, true};
}

/// Share of the container, up to the height that the particles fill [m^3].
double filled_volume(const Case &parameters, const dem::Room &room,
                     double solid_share)
{
  const double height = parameters.container.height;
  return room.container ? solid_share * room.volume_below(height)
                        : solid_share * room.section() * height;
}

/// Largest first.
std::vector<dem::ParticleShape> draw_filling(const Case &parameters,
                                             const ShapeLibrary &shapes,
                                             const dem::Room &room)
{
  const FillingParameters &f = parameters.filling;
  const double volume =
      filled_volume(parameters, room, f.density / parameters.particle.density);
  dem::Random random(static_cast<std::uint64_t>(f.seed));
  std::vector<dem::ParticleShape> particles =
      draw_particles(parameters, volume, shapes, random);
  if (particles.size() < static_cast<std::size_t>(f.layers))
    throw InputError(parameters.file +
                     ": Filling/layers = " + std::to_string(f.layers) +
                     ": must be at most the number of particles, " +
                     std::to_string(particles.size()));
  return particles;
}

dem::EngineParameters engine_settings(const Case &parameters,
                                      const dem::ParticleSystem &all)
{
  dem::EngineParameters settings;
  settings.particle = parameters.particle;
  settings.wall = parameters.wall;
  settings.surface = parameters.container.is_flexible()
                         ? parameters.membrane_contact
                         : parameters.wall;
  settings.geometry = parameters.contact_preparing(parameters.filling.safety);
  settings.friction_limit = parameters.friction_limit;
  settings.breakage = parameters.breakage;
  settings.local_damping = parameters.filling.local_damping;
  settings.gravity = -gravity * dem::Vec3::UnitZ();
  settings.geometry.usual_skin = 0.25 * all.smallest_radius();
  return settings;
}

/// Floor and wall; the ends of the cylinder are out of reach. Or the mesh.
void add_walls(const Case &parameters, const dem::Room &room,
               dem::Engine &engine)
{
  if (room.container)
  {
    add_container(parameters, room, engine);
    return add_mesh_walls(engine, parameters);
  }
  dem::add_plane(engine, dem::Vec3::Zero(), dem::Vec3::UnitZ());
  dem::Drum wall;
  wall.axis = dem::Vec3::UnitZ();
  wall.radius = 0.5 * parameters.container.diameter;
  wall.length = 1e3 * wall.radius;
  dem::set_drum(engine, wall);
  add_mesh_walls(engine, parameters);
}

/// In the order in which they are poured.
std::vector<dem::ParticleShape>
joined_layers(std::span<const std::vector<dem::ParticleShape>> layers)
{
  std::vector<dem::ParticleShape> all;
  for (const std::vector<dem::ParticleShape> &layer : layers)
    all.insert(all.end(), layer.begin(), layer.end());
  return all;
}

void draw_layers(const Case &parameters, CompactionScene &scene)
{
  const FillingParameters &f = parameters.filling;
  scene.shapes = load_shapes(parameters, "Filling", f.shapes, f.order);
  const std::vector<dem::ParticleShape> particles =
      draw_filling(parameters, scene.shapes, scene.room);
  scene.layers = dem::deal_layers(particles, f.layers);
  scene.all = unplaced_particles(parameters, joined_layers(scene.layers));
}

void place_layer(const Case &parameters, CompactionScene &scene)
{
  const FillingParameters &f = parameters.filling;
  const PlacedParticles particles =
      place_particles(parameters, {"Filling", f.particles, f.shapes, f.order});
  scene.shapes = particles.shapes;
  scene.all = unplaced_particles(parameters, particles.body);
  scene.layers = {particles.body};
  scene.placed = placed_layer(particles);
  if (scene.room.container)
    check_inside(parameters, particles, *scene.room.container);
  check_as_placed(parameters, particles,
                  {"Filling", f.largest_overlap,
                   engine_settings(parameters, scene.all),
                   [&](dem::Engine &engine)
                   { add_walls(parameters, scene.room, engine); }});
}

/// What the elastic plate stands.
void mind_plate(const Case &c, CompactionScene &scene)
{
  const CouplingParameters &rules = c.coupling;
  const fem::Solid plate = elastic_plate(c, 0.);
  const int n = rules.exchange_rules().particle_steps;
  const double own = plate.stable_time_step().guaranteed * rules.body_steps / n;
  if (!rules.is_body_implicit && own < scene.limit.step)
  {
    scene.limit = {own, "explicit steps of the elastic plate"};
    scene.setup.cap = own;
    scene.setup.step = first_step(c, scene.limit);
  }
  scene.setup.membrane_step = plate.stable_time_step().guaranteed;
  scene.setup.window = coupling::window_gain(
      {c.wall.normal_stiffness, c.wall.normal_damping,
       scene.all.smallest_mass()},
      *std::ranges::min_element(plate.nodal_mass()), n * scene.setup.step);
}

void choose_first_step(const Case &parameters, CompactionScene &scene)
{
  const dem::EngineParameters &engine = scene.engine->parameters();
  scene.limit = limit_on_walls(parameters, engine, scene.all,
                               dem::critical_step(engine, scene.all));
  std::optional<fem::Membrane> tube;
  if (parameters.container.is_flexible())
    tube.emplace(make_tube(parameters));
  scene.setup = choose_step(parameters, scene.limit, scene.all.smallest_mass(),
                            tube ? &*tube : nullptr);
  if (scene.setup.cap < scene.limit.step)
    scene.limit = {scene.setup.cap, "exchange with a node of the membrane"};
  if (parameters.plate.form == PlateKind::elastic)
    mind_plate(parameters, scene);
}
} // namespace

dem::Room room_in_mesh(const Case &parameters)
{
  const FillingParameters &f = parameters.filling;
  return container_room(parameters, dem::ContainerBottom::closed,
                        {parameters.container.height,
                         f.density / parameters.particle.density, f.layers,
                         f.solid_fraction});
}

CompactionScene make_compaction_scene(const Case &parameters)
{
  CompactionScene scene;
  scene.room = room_of(parameters);
  if (parameters.filling.particles.empty())
    draw_layers(parameters, scene);
  else
    place_layer(parameters, scene);
  scene.engine = std::make_unique<dem::Engine>(
      engine_settings(parameters, scene.all), dem::ranks_of_program());
  add_walls(parameters, scene.room, *scene.engine);
  scene.engine->set_breaking(false);
  choose_first_step(parameters, scene);
  return scene;
}

dem::PouringParameters pouring_parameters(const FillingParameters &f)
{
  dem::PouringParameters p;
  p.density = f.density;
  p.friction = f.friction;
  p.undercompaction = f.undercompaction;
  p.friction_decay = f.friction_decay;
  p.solid_fraction = f.solid_fraction;
  p.tamper_speed = f.tamper_speed;
  p.tamper_pressure = f.tamper_pressure;
  p.max_strokes = f.max_strokes;
  p.unbalanced_ratio = f.unbalanced_ratio;
  p.max_time = f.max_time;
  return p;
}

fem::Membrane make_tube(const Case &parameters)
{
  const ContainerParameters &c = parameters.container;
  const double radius =
      0.5 * c.diameter / std::cos(std::numbers::pi / c.elements_around);
  const double height = c.height + c.freeboard;
  const double edge = std::numbers::pi * c.diameter / c.elements_around;
  const int n_along = std::max(2, static_cast<int>(std::lround(height / edge)));
  return coupling::tube_between_rims(
      parameters.membrane,
      fem::cylinder_side(radius, height, c.elements_around, n_along));
}

double volume_below(const fem::Membrane &tube, int elements_around,
                    double height)
{
  const auto n = static_cast<std::size_t>(elements_around);
  const auto nodes = tube.positions();
  double sum = 0., z_below = 0., area_below = 0.;
  for (std::size_t ring = 0; ring < nodes.size() / n; ++ring)
  {
    double z = 0., area = 0.;
    for (std::size_t k = 0; k < n; ++k)
    {
      const dem::Vec3 &a = nodes[ring * n + k],
                      &b = nodes[ring * n + (k + 1) % n];
      z += a.z() / elements_around;
      area += 0.5 * (a.x() * b.y() - b.x() * a.y());
    }
    if (ring > 0)
    {
      const double top = std::min(z, height);
      const double share = (top - z_below) / (z - z_below);
      sum += (top - z_below) * std::lerp(area_below, area, 0.5 * share);
    }
    if (z >= height)
      break;
    z_below = z;
    area_below = area;
  }
  return sum;
}
} // namespace spall
