#include "subgrade/scene.h"

#include "case/digits.h"
#include "case/gravity.h"
#include "case/parameter.h"
#include "errors.h"
#include "specimen/container_mesh.h"
#include "specimen/mesh_walls.h"
#include "specimen/obtained_gradation.h"
#include "specimen/placed_particles.h"
#include "subgrade/layer_room.h"

#include <dem/engine_boundaries.h>
#include <dem/measure/totals.h>
#include <dem/parallel/mpi_ranks.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace spall
{
namespace
{
/// Windows that adapt are at most this share of what explicit steps of the
/// ground stand [-].
constexpr double share_of_explicit = 0.8;

/// Gains may come to this share of the limit of one pass: more than one contact
/// may load a node [-].
constexpr double share_of_gain = 0.5;

coupling::ExchangeContact contact_with_ground(const Case &c,
                                              double smallest_particle)
{
  const dem::WallMaterial &material = c.subgrade.contact;
  return {material.normal_stiffness, material.normal_damping,
          smallest_particle};
}

dem::EngineParameters engine_settings(const Case &c,
                                      const dem::ParticleSystem &all)
{
  dem::EngineParameters settings;
  settings.particle = c.particle;
  settings.wall = c.wall;
  settings.surface = c.subgrade.contact;
  settings.geometry = c.contact_preparing(c.subgrade.layer.safety);
  settings.friction_limit = c.friction_limit;
  settings.breakage = c.breakage;
  settings.local_damping = c.subgrade.layer.local_damping;
  settings.gravity = -gravity * dem::Vec3::UnitZ();
  settings.geometry.usual_skin = 0.25 * all.smallest_radius();
  return settings;
}

std::vector<dem::ParticleShape>
draw_layer(const Case &c, const ParticleBox &scene, dem::Random &random)
{
  const LayerParameters &l = c.subgrade.layer;
  const double volume =
      scene.room.container
          ? l.solid_fraction * scene.room.volume_below(l.thickness)
          : l.solid_fraction * l.length * l.width * l.thickness;
  std::vector<dem::ParticleShape> particles =
      draw_particles(c, volume, scene.shapes, random);
  if (particles.size() < static_cast<std::size_t>(l.layers))
    throw InputError(c.file + ": Layer/layers = " + std::to_string(l.layers) +
                     ": must be at most the number of particles, " +
                     std::to_string(particles.size()));
  return particles;
}

void draw_layers(const Case &c, ParticleBox &scene)
{
  const LayerParameters &l = c.subgrade.layer;
  scene.shapes = load_shapes(c, "Layer", l.shapes, l.order);
  dem::Random random(static_cast<std::uint64_t>(l.seed));
  const std::vector<dem::ParticleShape> particles =
      draw_layer(c, scene, random);
  scene.all = unplaced_particles(c, particles);
  scene.layers = dem::deal_layers(particles, l.layers);
}

void add_walls(const Case &c, const dem::Room &room, dem::Engine &engine)
{
  add_sides(c, room, engine);
  add_mesh_walls(engine, c);
}

void place_layer(const Case &c, ParticleBox &scene)
{
  const LayerParameters &l = c.subgrade.layer;
  const PlacedParticles particles =
      place_particles(c, {"Layer", l.particles, l.shapes, l.order});
  scene.shapes = particles.shapes;
  scene.all = unplaced_particles(c, particles.body);
  scene.layers = {particles.body};
  scene.placed = placed_layer(particles);
  if (scene.room.container)
    check_inside(c, particles, *scene.room.container);
  const auto add_boundaries = [&](dem::Engine &engine)
  {
    dem::add_plane(engine, dem::Vec3::Zero(), dem::Vec3::UnitZ()); // the ground
    add_walls(c, scene.room, engine);
  };
  check_as_placed(c, particles,
                  {"Layer", l.largest_overlap, engine_settings(c, scene.all),
                   add_boundaries});
}
} // namespace

ParticleBox make_particle_box(const Case &c)
{
  const LayerParameters &l = c.subgrade.layer;
  ParticleBox scene;
  scene.room = layer_room(c);
  if (l.particles.empty())
    draw_layers(c, scene);
  else
    place_layer(c, scene);
  scene.engine = std::make_unique<dem::Engine>(engine_settings(c, scene.all),
                                               dem::ranks_of_program());
  add_walls(c, scene.room, *scene.engine);
  scene.engine->set_breaking(false);
  const dem::EngineParameters &engine = scene.engine->parameters();
  scene.limit = limit_on_walls(
      c, engine, scene.all,
      dem::critical_step(engine, scene.all,
                         "the subgrade (GroundContact/normal_stiffness)"));
  return scene;
}

dem::PouringParameters pouring_parameters(const Case &c)
{
  const LayerParameters &l = c.subgrade.layer;
  dem::PouringParameters p;
  p.density = l.is_tamped ? l.solid_fraction * c.particle.density : 0.;
  p.friction = l.friction;
  p.solid_fraction = l.initial_solid_fraction;
  p.tamper_speed = l.tamper_speed;
  p.tamper_pressure = l.tamper_pressure;
  p.max_strokes = l.max_strokes;
  p.unbalanced_ratio = l.unbalanced_ratio;
  p.max_time = l.max_time;
  return p;
}

fem::SurfaceMesh plate_surface(const LoadPlateParameters &p, double height)
{
  const Footprint half = footprint(p);
  constexpr std::int32_t n = 8; // quads along a side: a disc has 32 corners
  fem::SurfaceMesh mesh;
  const auto number = [](std::int32_t i, std::int32_t j)
  { return j * (n + 1) + i; };
  for (std::int32_t j = 0; j <= n; ++j)
    for (std::int32_t i = 0; i <= n; ++i)
    {
      double x = 2. * i / n - 1., y = 2. * j / n - 1.;
      if (p.form == PlateForm::disc) // the square onto the disc
      {
        const double across = x * std::sqrt(1. - 0.5 * y * y);
        y *= std::sqrt(1. - 0.5 * x * x);
        x = across;
      }
      mesh.nodes.emplace_back(half.half_x * x, half.half_y * y, height);
    }
  for (std::int32_t j = 0; j < n; ++j)
    for (std::int32_t i = 0; i < n; ++i)
      mesh.quads.push_back({number(i, j), number(i, j + 1),
                            number(i + 1, j + 1), number(i + 1, j)});
  std::vector<std::int32_t> rim; // counter-clockwise seen from above
  for (std::int32_t k = 0; k < n; ++k)
    rim.push_back(number(k, 0));
  for (std::int32_t k = 0; k < n; ++k)
    rim.push_back(number(n, k));
  for (std::int32_t k = n; k > 0; --k)
    rim.push_back(number(k, n));
  for (std::int32_t k = n; k > 0; --k)
    rim.push_back(number(0, k));
  const auto first = static_cast<std::int32_t>(mesh.nodes.size());
  const auto n_rim = static_cast<std::int32_t>(rim.size());
  for (const std::int32_t below : rim)
    mesh.nodes.push_back(mesh.nodes[static_cast<std::size_t>(below)] +
                         p.height * Eigen::Vector3d::UnitZ());
  for (std::int32_t k = 0; k < n_rim; ++k)
  {
    const std::int32_t next = (k + 1) % n_rim;
    mesh.quads.push_back({rim[static_cast<std::size_t>(k)],
                          rim[static_cast<std::size_t>(next)], first + next,
                          first + k});
  }
  return mesh;
}

fem::PlateBodyParameters plate_body(const LoadPlateParameters &p, double height)
{
  fem::PlateBodyParameters body;
  body.mass = p.mass;
  const double xx = p.length * p.length, yy = p.width * p.width,
               zz = p.height * p.height;
  body.inertia =
      p.form == PlateForm::disc
          ? fem::disc_inertia(p.mass, 0.5 * p.diameter, p.height)
          : Eigen::Vector3d(p.mass / 12. *
                            Eigen::Vector3d(yy + zz, zz + xx, xx + yy));
  body.centre = {0., 0., height + 0.5 * p.height};
  if (p.motion == PlateMotion::vertical)
  {
    body.moves = {false, false, true};
    body.turns = {false, false, false};
  }
  return body;
}

double height_above(const dem::Engine &engine, const LoadPlateParameters &plate)
{
  const Footprint half = footprint(plate);
  const dem::ParticleSystem &own = engine.particles();
  return dem::largest_of_particles(
      engine, 0.,
      [&](std::size_t i)
      {
        const dem::Vec3 &at = own.position(i);
        const double reach = own.shape[i].circumscribed_radius;
        const bool is_below = std::abs(at.x()) < half.half_x + reach &&
                              std::abs(at.y()) < half.half_y + reach;
        return is_below ? at.z() + reach : 0.;
      });
}

/// A disc has as many corners as its mesh.
dem::Prism column_below(const LoadPlateParameters &plate, double low,
                        double high)
{
  const Footprint half = footprint(plate);
  if (plate.form == PlateForm::block)
    return dem::prism_of({-half.half_x, -half.half_y, low},
                         {half.half_x, half.half_y, high});
  constexpr int n = 32;
  dem::Prism column{{}, low, high};
  for (int k = 0; k < n; ++k)
  {
    const double angle = 2. * std::numbers::pi * k / n;
    column.corners.emplace_back(half.half_x * std::cos(angle),
                                half.half_y * std::sin(angle));
  }
  return column;
}

coupling::WindowGain ground_gain(const Case &c,
                                 const coupling::DeformableBody &ground,
                                 double smallest_particle, double window)
{
  const std::vector<double> mass = ground.nodal_mass();
  return coupling::window_gain(contact_with_ground(c, smallest_particle),
                               *std::ranges::min_element(mass), window);
}

int stable_particle_steps(const Case &c, const coupling::DeformableBody &ground,
                          double smallest_particle, double time_step)
{
  const int most = c.coupling.rules.particle_steps;
  if (c.coupling.rules.window_tolerance == 0.)
    return most;
  const coupling::WindowGain one =
      ground_gain(c, ground, smallest_particle, time_step);
  // The gain goes with the square of the window.
  double n = std::sqrt(share_of_gain * one.one_pass_limit / one.gain);
  if (!c.coupling.is_body_implicit)
    n = std::min(n, share_of_explicit * c.coupling.body_steps *
                        ground.stable_time_step() / time_step);
  return static_cast<int>(std::clamp(n, 1., static_cast<double>(most)));
}

SetupStep ground_setup(const Case &c, const coupling::DeformableBody &ground,
                       double smallest_particle, double time_step,
                       int particle_steps)
{
  const std::vector<double> mass = ground.nodal_mass();
  const coupling::ExchangeRule rule = c.coupling.exchange_rules().rule;
  SetupStep setup;
  setup.step = time_step;
  setup.membrane_step = ground.stable_time_step();
  setup.window =
      ground_gain(c, ground, smallest_particle, particle_steps * time_step);
  if (rule == coupling::ExchangeRule::every_step)
    setup.gain = coupling::exchange_gain(
        contact_with_ground(c, smallest_particle),
        {&*std::ranges::min_element(mass), 1}, setup.membrane_step, time_step);
  else
    setup.gain = {setup.window.gain,
                  rule == coupling::ExchangeRule::one_pass
                      ? setup.window.one_pass_limit
                      : std::numeric_limits<double>::infinity()};
  return setup;
}

void check_ground_setup(const Case &c, const SetupStep &setup,
                        int particle_steps)
{
  const CouplingParameters &p = c.coupling;
  const double own = particle_steps * setup.step / p.body_steps;
  if (!p.is_body_implicit && own > setup.membrane_step)
    throw InputError(
        c.file + ": Coupling/body_steps = " + std::to_string(p.body_steps) +
        ": explicit steps of the subgrade of " + in_four_digits(own) +
        " s must be at most " + in_four_digits(setup.membrane_step) +
        " s: take more of them, or body_time = implicit");
  if (!(setup.gain->gain < setup.gain->limit))
    throw InputError(c.file + ": Coupling/particle_steps = " +
                     std::to_string(particle_steps) + ": exchange gain " +
                     in_four_digits(setup.gain->gain) + " must be below " +
                     in_four_digits(setup.gain->limit) +
                     ": take shorter windows or Coupling/exchange = iterated");
}
} // namespace spall
