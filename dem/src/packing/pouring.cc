#include <dem/binary.h>
#include <dem/boundary/wall_clearance.h>
#include <dem/engine_boundaries.h>
#include <dem/packing/pouring.h>
#include <dem/parallel/distribution.h>
#include <dem/parallel/rank_sums.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <sstream>
#include <stdexcept>

namespace dem
{
namespace
{
/// Interval of the checks for rest of the particles [steps].
constexpr std::int64_t rest_interval = 200;
/// Over which the pressure of the tamper is averaged [s].
constexpr double averaging_time = 2e-4;
/// Below which particles might as well slide freely [-].
constexpr double least_friction = 0.01;
/// Of the tamper above what it does not touch, over the width of the room [-].
constexpr double clearance = 1e-3;

double volume_of(std::span<const ParticleShape> particles)
{
  double sum = 0.;
  for (const ParticleShape &particle : particles)
    sum += particle.volume;
  return sum;
}

double largest_radius(std::span<const ParticleShape> particles)
{
  double largest = 0.;
  for (const ParticleShape &particle : particles)
    largest = std::max(largest, particle.circumscribed_radius);
  return largest;
}
} // namespace

double Room::section() const
{
  if (container)
    return container->section(container->rim());
  return is_round ? 0.25 * std::numbers::pi * width_x * width_x
                  : width_x * width_y;
}

double Room::section_at(double height) const
{
  return container ? container->section(height) : section();
}

double Room::volume_below(double height) const
{
  return container ? container->volume_below(height) : section() * height;
}

double Room::height_of(double mass, double density) const
{
  return container ? container->height_of(mass / density)
                   : mass / (density * section());
}

double top_of(const Engine &engine, double floor)
{
  const ParticleSystem &particles = engine.particles();
  std::array top{floor};
  for (std::size_t i = 0; i < particles.n_owned(); ++i)
    top[0] =
        std::max(top[0], particles.position(i).z() +
                             std::max(particles.radius(i),
                                      particles.shape[i].circumscribed_radius));
  engine.distribution().ranks().max(top);
  return top[0];
}

double unbalanced_weight_ratio(const Engine &engine)
{
  const ParticleSystem &particles = engine.particles();
  const Vec3 &gravity = engine.parameters().gravity;
  ExactSum force, weight;
  for (std::size_t i = 0; i < particles.n_owned(); ++i)
  {
    force.add((particles.load[i].force + particles.mass(i) * gravity).norm());
    weight.add(particles.mass(i) * gravity.norm());
  }
  std::array sums{force, weight};
  sum_over_ranks(engine.distribution().ranks(), sums);
  return sums[0].value() / sums[1].value();
}

std::vector<std::vector<ParticleShape>>
deal_layers(std::span<const ParticleShape> particles, int n)
{
  std::vector<std::vector<ParticleShape>> layers(static_cast<std::size_t>(n));
  std::vector<double> volume(layers.size(), 0.);
  for (const ParticleShape &particle : particles)
  {
    const auto least = std::ranges::min_element(volume);
    layers[static_cast<std::size_t>(least - volume.begin())].push_back(
        particle);
    *least += particle.volume;
  }
  return layers;
}

Pouring::Pouring(const Room &its_room, const PouringParameters &p,
                 std::vector<std::vector<ParticleShape>> layers,
                 std::uint64_t its_seed)
    : room(its_room), parameters(p), bodies(std::move(layers)), seed(its_seed)
{
}

void Pouring::set_first_layer(PlacedLayer placed)
{
  first = std::move(placed);
}

std::vector<ParticleShape> Pouring::particles() const
{
  std::vector<ParticleShape> all;
  all.reserve(n_particles());
  for (const std::vector<ParticleShape> &layer : bodies)
    all.insert(all.end(), layer.begin(), layer.end());
  return all;
}

std::size_t Pouring::n_particles() const
{
  std::size_t n = 0;
  for (const std::vector<ParticleShape> &layer : bodies)
    n += layer.size();
  return n;
}

/// Of the cloud of a layer, or up to the top of the one that is placed [m].
double Pouring::fall_height(std::size_t layer) const
{
  if (first.placement.empty() || layer > 0)
    return volume_of(bodies[layer]) /
           (parameters.solid_fraction * room.section());
  double top = 0.;
  for (const Placement &placed : first.placement)
    top = std::max(top, placed.position.z() - room.floor.z());
  return top;
}

double Pouring::expected_time(const Vec3 &gravity) const
{
  constexpr double n_falls = 3.;
  double whole = 0., sum = 0.;
  for (const std::vector<ParticleShape> &layer : bodies)
    whole += volume_of(layer);
  double filled = 0.;
  for (std::size_t layer = 0; layer < bodies.size(); ++layer)
  {
    filled += volume_of(bodies[layer]);
    const double tamping =
        parameters.density > 0.
            ? 2. * largest_radius(bodies[layer]) / parameters.tamper_speed
            : 0.;
    const double fall = std::sqrt(2. * fall_height(layer) / gravity.norm());
    sum += filled / whole * (n_falls * fall + tamping);
  }
  return sum;
}

void Pouring::prepare(Engine &engine)
{
  plane = add_plane(engine, room.floor + room.width_x * Vec3::UnitZ(),
                    -Vec3::UnitZ());
  deactivate_plane(engine, plane);
  now.friction = engine.parameters().particle.friction;
  engine.set_friction(parameters.friction);
}

void Pouring::steer(Engine &engine, double time_step)
{
  follow_pressure(engine, time_step);
  switch (now.stage)
  {
  case Stage::waiting:
    return pour(engine);
  case Stage::settling:
    return settle(engine);
  case Stage::tamping:
    return tamp(engine);
  case Stage::lifting:
    return lift(engine);
  case Stage::resting:
    if (!is_at_rest(engine, parameters.unbalanced_ratio))
      return;
    // Particles that carry nothing would roll on for ever.
    engine.come_to_rest();
    return enter(Stage::done, engine);
  case Stage::done:
    return;
  }
}

void Pouring::enter(Stage next, const Engine &engine)
{
  now.stage = next;
  now.since = engine.time();
}

void Pouring::follow_pressure(const Engine &engine, double time_step)
{
  const Plane &tamper = planes(engine)[plane];
  const double present =
      tamper.force.z() == 0.
          ? 0.
          : tamper.force.z() /
                room.section_at(tamper.point.z() - room.floor.z());
  now.pressure +=
      std::min(1., time_step / averaging_time) * (present - now.pressure);
  now.peak = std::max(now.peak, now.pressure);
}

/// Height above the floor at which the present particles have the required
/// density of so many layers [m].
double Pouring::goal() const
{
  const auto left = static_cast<double>(bodies.size() - finished.size() - 1);
  const double looser = left == 0. ? 0.
                                   : parameters.undercompaction * left /
                                         static_cast<double>(bodies.size() - 1);
  return room.height_of(now.mass, (1. - looser) * parameters.density);
}

/// Where the particles of a layer begin to fall. A cloud in which they find no
/// position, as near walls, is made higher.
std::vector<Placement> Pouring::cloud_above(double floor,
                                            const InsertionBox &slab) const
{
  constexpr int n_tries = 12;
  constexpr double growth = 1.25;
  const std::vector<ParticleShape> &layer = bodies[finished.size()];
  InsertionBox box = slab;
  double height =
      volume_of(layer) / (parameters.solid_fraction * room.section());
  for (int k = 1;; ++k, height *= growth)
    try
    {
      box.upper.z() = floor + height;
      Random random(seed + finished.size());
      return insert_particles(layer, box, random);
    }
    catch (const NoFreePosition &)
    {
      if (k == n_tries)
        throw;
    }
}

/// The first layer, where it is placed.
void Pouring::pour_placed(Engine &engine) const
{
  const std::vector<ParticleShape> &layer = bodies.front();
  for (std::size_t i = 0; i < layer.size(); ++i)
    engine.add_particle(layer[i], first.placement[i].position,
                        first.placement[i].orientation);
  ParticleSystem &particles = engine.particles();
  for (std::size_t row = 0; row < particles.size(); ++row)
  {
    const auto k = static_cast<std::size_t>(particles.id[row]);
    particles.velocity(row) = first.velocity[k];
    particles.spin(row) = first.spin[k];
  }
}

void Pouring::pour_cloud(Engine &engine) const
{
  const std::vector<ParticleShape> &layer = bodies[finished.size()];
  const double floor = top_of(engine, room.floor.z());
  const Vec3 half(0.5 * room.width_x,
                  0.5 * (room.is_round ? room.width_x : room.width_y), 0.);
  InsertionBox box;
  box.lower = Vec3(room.floor.x(), room.floor.y(), floor) - half;
  box.upper = Vec3(room.floor.x(), room.floor.y(), floor) + half;
  box.sees_surfaces = engine.parameters().geometry.follows_surfaces();
  box.is_round = room.is_round;
  WallClearance walls;
  for (const MeshWall &wall : mesh_walls(engine))
    walls.add(wall.surface);
  if (room.container || !walls.is_empty())
    box.is_clear = [&](const Vec3 &centre, double radius)
    {
      return (!room.container ||
              room.container->holds(centre - room.floor.z() * Vec3::UnitZ(),
                                    radius)) &&
             walls.is_clear(centre, radius);
    };
  const std::vector<Placement> placements = cloud_above(floor, box);
  for (std::size_t i = 0; i < layer.size(); ++i)
    engine.add_particle(layer[i], placements[i].position,
                        placements[i].orientation);
}

void Pouring::pour(Engine &engine)
{
  const std::vector<ParticleShape> &layer = bodies[finished.size()];
  engine.synchronize();
  if (finished.empty() && !first.placement.empty())
    pour_placed(engine);
  else
    pour_cloud(engine);
  now.mass += volume_of(layer) * engine.parameters().particle.density;
  now.strokes = 0;
  now.peak = 0.;
  now.depth = parameters.density > 0. ? goal() : 0.;
  enter(Stage::settling, engine);
}

/// Called now and then. Throws std::runtime_error after too long.
bool Pouring::is_at_rest(Engine &engine, double limit)
{
  if (engine.n_steps() % rest_interval != 0 || engine.time() == now.since)
    return false;
  engine.synchronize();
  now.unbalanced_ratio = unbalanced_weight_ratio(engine);
  if (engine.time() - now.since > parameters.max_time)
  {
    std::ostringstream text;
    text << "pouring: layer " << std::min(finished.size() + 1, bodies.size())
         << " of " << bodies.size() << " is not at rest after "
         << parameters.max_time << " s: resultant forces over weight "
         << now.unbalanced_ratio << ", limit " << limit;
    throw NoRest(text.str());
  }
  return now.unbalanced_ratio < limit;
}

void Pouring::settle(Engine &engine)
{
  if (!is_at_rest(engine, 10. * parameters.unbalanced_ratio))
    return;
  if (parameters.density > 0.)
    lower_tamper(engine);
  else
    close_layer(engine);
}

void Pouring::lower_tamper(Engine &engine)
{
  engine.synchronize();
  const double start =
      top_of(engine, room.floor.z()) + clearance * room.width_x;
  place_plane(engine, plane, {room.floor.x(), room.floor.y(), start});
  planes(engine)[plane].velocity = -parameters.tamper_speed * Vec3::UnitZ();
  ++now.strokes;
  enter(Stage::tamping, engine);
}

/// Down to its depth at least, and until it is felt.
void Pouring::tamp(Engine &engine)
{
  Plane &tamper = planes(engine)[plane];
  const double height = tamper.point.z() - room.floor.z();
  const bool is_deep =
      height <= now.depth &&
      tamper.force.z() > parameters.level_pressure * room.section_at(height);
  if (!is_deep && now.pressure < parameters.tamper_pressure)
    return;
  tamper.velocity = -tamper.velocity;
  now.level = height;
  enter(Stage::lifting, engine);
}

void Pouring::lift(Engine &engine)
{
  const Plane &tamper = planes(engine)[plane];
  const double height = tamper.point.z() - room.floor.z();
  if (tamper.force.z() > parameters.level_pressure * room.section_at(height))
    now.level = height;
  if (tamper.force.z() != 0. || height < now.level + clearance * room.width_x)
    return;
  deactivate_plane(engine, plane);
  if (goes_on(engine))
    return enter(Stage::settling, engine);
  close_layer(engine);
}

/// Another stroke on a layer that is too loose: deeper, or with less friction.
bool Pouring::goes_on(Engine &engine)
{
  const double missing = now.level - goal();
  if (missing <= parameters.tolerance * goal())
    return false;
  if (now.peak < parameters.tamper_pressure)
  {
    now.depth -= missing;
    return now.strokes < parameters.max_strokes + now.decays;
  }
  const double friction =
      parameters.friction_decay * engine.parameters().particle.friction;
  if (parameters.friction_decay == 1. || finished.size() + 1 < bodies.size() ||
      friction < least_friction)
    return false;
  engine.set_friction(friction);
  ++now.decays;
  now.peak = 0.;
  now.depth = goal();
  return true;
}

void Pouring::close_layer(Engine &engine)
{
  Layer layer;
  layer.mass = now.mass;
  layer.time = engine.time();
  layer.friction = engine.parameters().particle.friction;
  if (parameters.density > 0.)
  {
    layer.height = now.level;
    layer.density = now.mass / room.volume_below(now.level);
    layer.pressure = now.peak;
    layer.strokes = now.strokes;
  }
  finished.push_back(layer);
  if (finished.size() < bodies.size())
    return enter(Stage::waiting, engine);
  engine.set_friction(now.friction);
  enter(Stage::resting, engine);
}

void Pouring::save(std::ostream &out) const
{
  write_value(out, plane);
  write_value(out, now);
  write_column(out, finished);
}

void Pouring::restore(std::istream &in)
{
  read_value(in, plane);
  read_value(in, now);
  read_column(in, finished);
}
} // namespace dem
