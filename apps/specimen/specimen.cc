#include "specimen/specimen.h"

#include "case/digits.h"
#include "case/file.h"
#include "case/parameter.h"
#include "errors.h"
#include "specimen/mesh_walls.h"
#include "specimen/obtained_gradation.h"
#include "specimen/placed_particles.h"
#include "specimen/sheet_file.h"

#include <dem/engine_boundaries.h>
#include <dem/packing/insertion.h>
#include <dem/parallel/mpi_ranks.h>
#include <fem/membrane.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

namespace spall
{
dem::ParticleSystem
unplaced_particles(const Case &parameters,
                   const std::vector<dem::ParticleShape> &particles)
{
  dem::ParticleSystem all;
  for (const dem::ParticleShape &particle : particles)
  {
    all.add(particle, dem::Vec3::Zero(), dem::Quaternion::Identity(),
            parameters.particle.density);
    all.is_breakable.back() =
        particle.series && 2. * dem::mean_radius(particle) >=
                               parameters.breakage.min_diameter * (1. - 1e-9);
  }
  return all;
}

dem::EngineParameters engine_parameters(const Case &parameters)
{
  dem::EngineParameters engine;
  engine.particle = parameters.particle;
  engine.particle.friction = parameters.preparation.friction;
  engine.wall = parameters.wall;
  engine.surface = parameters.boundary.lateral == Lateral::membrane
                       ? parameters.membrane_contact
                       : parameters.wall;
  engine.geometry = parameters.contact_preparing(parameters.preparation.safety);
  engine.friction_limit = parameters.friction_limit;
  engine.breakage = parameters.breakage;
  engine.local_damping = parameters.preparation.local_damping;
  engine.density_scaling_diameter = parameters.time.density_scaling_diameter;
  return engine;
}

dem::Vec3 nominal_size(const SpecimenParameters &s)
{
  return s.form == SpecimenForm::box
             ? dem::Vec3::Constant(s.side)
             : dem::Vec3(s.diameter, s.diameter, s.height);
}

fem::SurfaceMesh lateral_mesh(const Case &parameters, const dem::Vec3 &lower,
                              const dem::Vec3 &upper)
{
  const BoundaryParameters &b = parameters.boundary;
  if (!b.mesh.empty())
    return read_sheet(parameters, lower, upper);
  const int n = b.elements_per_side;
  if (parameters.specimen.form == SpecimenForm::box)
    return fem::box_sides(lower, upper, {n, n, n});
  const dem::Vec3 size = upper - lower;
  const double edge = std::numbers::pi * size.x() / b.elements_around;
  const int n_along =
      std::max(2, static_cast<int>(std::lround(size.z() / edge)));
  fem::SurfaceMesh mesh = fem::cylinder_side(
      0.5 * size.x() / std::cos(std::numbers::pi / b.elements_around), size.z(),
      b.elements_around, n_along);
  const dem::Vec3 foot(0.5 * (lower.x() + upper.x()),
                       0.5 * (lower.y() + upper.y()), lower.z());
  for (dem::Vec3 &node : mesh.nodes)
    node += foot;
  return mesh;
}

namespace
{
/// Volume of the particles [m^3].
double nominal_solid_volume(const SpecimenParameters &s)
{
  if (s.form == SpecimenForm::box)
    return s.solid_fraction * s.side * s.side * s.side;
  return s.solid_fraction * 0.25 * std::numbers::pi * s.diameter * s.diameter *
         s.height;
}

/// Of the random cloud, formed like the specimen [m].
dem::Vec3 cloud_size(const SpecimenParameters &s, double solid_volume)
{
  const dem::Vec3 size = nominal_size(s), form = size / size.x();
  const double section =
      s.form == SpecimenForm::box ? 1. : 0.25 * std::numbers::pi;
  return form * std::cbrt(solid_volume / s.initial_solid_fraction /
                          (section * form.prod()));
}
/// Refuses walls that reach beyond the membrane or the periodic cell, as far as
/// its size is known; `origin`: of the walls, from the middle of the cloud [m].
void require_walls_inside(const Case &parameters, const dem::Vec3 &origin)
{
  if (parameters.walls.empty() || parameters.boundary.lateral == Lateral::rigid)
    return;
  dem::Engine walls{dem::EngineParameters{}};
  add_mesh_walls(walls, parameters, origin);
  const std::string what = walls_beyond(parameters, walls, dem::Vec3::Zero(),
                                        nominal_size(parameters.specimen));
  if (!what.empty())
    throw InputError(parameters.file + ": " + what);
}

/// Particles by the gradation, in a random cloud from the origin to `box`.
PlacedParticles drawn_particles(const Case &parameters)
{
  const SpecimenParameters &s = parameters.specimen;
  require_walls_inside(parameters, dem::Vec3::Zero());
  PlacedParticles cloud;
  cloud.shapes = load_shapes(parameters, "Specimen", s.shapes, s.order);
  dem::Random random(static_cast<std::uint64_t>(s.seed));
  const std::vector<dem::ParticleShape> drawn =
      draw_particles(parameters, nominal_solid_volume(s), cloud.shapes, random);
  if (drawn.empty())
    throw InputError(parameters.file + ": Specimen/solid_fraction = " +
                     std::to_string(s.solid_fraction) +
                     ": gives no room for a single particle of the gradation");
  double volume = 0.;
  for (const dem::ParticleShape &particle : drawn)
    volume += particle.volume;
  cloud.box = cloud_size(s, volume);
  // Walls of the case are placed about the middle.
  cloud.origin = 0.5 * cloud.box;
  try
  {
    cloud.add_at_rest(
        drawn,
        dem::insert_particles(drawn,
                              {dem::Vec3::Zero(), cloud.box,
                               parameters.contact.follows_surfaces(),
                               s.form == SpecimenForm::cylinder,
                               clear_of_walls(parameters, cloud.origin)},
                              random),
        "Specimen");
  }
  catch (const dem::NoFreePosition &error)
  {
    throw InputError(parameters.file + ": " + error.what() +
                     ": Specimen/initial_solid_fraction = " +
                     number_text(s.initial_solid_fraction) + " must be lower");
  }
  return cloud;
}

/// The particles of a file, moved so that what encloses them begins at the
/// origin.
PlacedParticles given_particles(const Case &parameters)
{
  const SpecimenParameters &s = parameters.specimen;
  PlacedParticles given =
      place_particles(parameters, {"Specimen", s.particles, s.shapes, s.order});
  if (!given.box.isZero())
  {
    require_walls_inside(parameters, -0.5 * given.box);
    return given;
  }
  dem::Vec3 lower = dem::Vec3::Constant(std::numeric_limits<double>::max()),
            upper = -lower;
  for (std::size_t k = 0; k < given.size(); ++k)
  {
    const dem::Vec3 reach =
        dem::Vec3::Constant(given.body[k].circumscribed_radius);
    lower = lower.cwiseMin(given.placement[k].position - reach);
    upper = upper.cwiseMax(given.placement[k].position + reach);
  }
  for (dem::Placement &placement : given.placement)
    placement.position -= lower;
  given.box = upper - lower;
  given.origin = -lower;
  require_walls_inside(parameters, given.origin - 0.5 * given.box);
  return given;
}

/// No particle may meet two images of another one within the widest skin of the
/// lists.
void require_unique_images(const Case &parameters,
                           const PlacedParticles &particles, double skin)
{
  constexpr double widest = 2.; // over the usual skin
  double largest = 0.;
  for (const dem::ParticleShape &particle : particles.body)
    largest = std::max(largest, particle.circumscribed_radius);
  const double least = 2. * (2. * largest + widest * skin);
  if (parameters.specimen.side < least)
    throw InputError(parameters.file + ": Specimen/side = " +
                     number_text(parameters.specimen.side) +
                     " m: must be at least " + in_four_digits(least) +
                     " m with Boundary/lateral = periodic, where no particle "
                     "may meet two images of another one");
}

dem::SpecimenWalls add_walls(const Case &parameters, const dem::Vec3 &lower,
                             const dem::Vec3 &upper, dem::Engine &engine)
{
  if (parameters.specimen.form == SpecimenForm::cylinder)
    return dem::add_cylinder(engine, lower, upper);
  if (parameters.boundary.lateral == Lateral::periodic)
    return dem::add_periodic_cell(engine, lower, upper, {true, true, false});
  return dem::add_box(engine, lower, upper);
}
} // namespace

Specimen make_specimen(const Case &parameters)
{
  const SpecimenParameters &s = parameters.specimen;
  const PlacedParticles particles = s.particles.empty()
                                        ? drawn_particles(parameters)
                                        : given_particles(parameters);
  dem::EngineParameters engine = engine_parameters(parameters);
  engine.geometry.usual_skin = 0.25 * particles.smallest_radius();
  if (parameters.boundary.lateral == Lateral::periodic)
    require_unique_images(
        parameters, particles,
        std::max(engine.geometry.usual_skin, parameters.contact.skin));
  Specimen specimen;
  specimen.shapes = particles.shapes;
  specimen.engine =
      std::make_unique<dem::Engine>(engine, dem::ranks_of_program());
  const auto add_boundaries = [&](dem::Engine &to)
  {
    specimen.walls =
        add_walls(parameters, dem::Vec3::Zero(), particles.box, to);
    add_mesh_walls(to, parameters, particles.origin);
    for (dem::MeshWall &wall : dem::mesh_walls(to))
      wall.start_in(std::numeric_limits<double>::infinity()); // until loading
  };
  if (!s.particles.empty())
    check_as_placed(parameters, particles,
                    {"Specimen", s.largest_overlap, engine, add_boundaries});
  add_particles(particles, *specimen.engine);
  add_boundaries(*specimen.engine);
  return specimen;
}

std::string walls_beyond(const Case &parameters, const dem::Engine &engine,
                         const dem::Vec3 &middle, const dem::Vec3 &size)
{
  const bool is_round = parameters.specimen.form == SpecimenForm::cylinder;
  for (const dem::MeshWall &wall : dem::mesh_walls(engine))
    for (const dem::Vec3 &point : wall.surface.position)
    {
      const dem::Vec3 at = (point - middle).cwiseAbs();
      const dem::Vec3 beyond =
          is_round ? dem::Vec3(at.head<2>().norm() - 0.5 * size.x(), 0.,
                               at.z() - 0.5 * size.z())
                   : dem::Vec3(at - 0.5 * size);
      if (beyond.maxCoeff() > 0.)
        return "Walls/" + wall.label + ": reaches " +
               in_four_digits(beyond.maxCoeff()) +
               " m beyond the specimen: must be inside of the membrane or the "
               "periodic cell, or Boundary/lateral = rigid";
    }
  return {};
}

namespace
{
/// Input of the exchange: the heaviest pair on the lightest node.
struct MembraneNode
{
  coupling::ExchangeContact contact;
  double mass = 0.;          ///< lightest that moves [kg]
  double membrane_step = 0.; ///< longest of the membrane alone [s]
};

MembraneNode lightest_node(const Case &parameters, double lightest_particle,
                           const fem::Membrane &membrane)
{
  // All nodes but those of the two rims move.
  const fem::SurfaceMesh &mesh = membrane.mesh();
  const auto [low, high] = std::ranges::minmax(
      mesh.nodes, {}, [](const dem::Vec3 &node) { return node.z(); });
  const double margin = 1e-6 * (high.z() - low.z());
  double lightest = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < mesh.nodes.size(); ++k)
    if (const double z = mesh.nodes[k].z();
        z > low.z() + margin && z < high.z() - margin)
      lightest = std::min(lightest, membrane.nodal_mass()[k]);
  const dem::WallMaterial &contact = parameters.membrane_contact;
  return {{contact.normal_stiffness, contact.normal_damping, lightest_particle},
          lightest,
          membrane.stable_time_step()};
}

void check_fixed(const Case &parameters, const dem::StepLimit &limit)
{
  if (parameters.time.fixed_step > limit.step)
    throw InputError(parameters.file + ": Time/fixed_step = " +
                     in_four_digits(parameters.time.fixed_step) +
                     " s: must be at most " + in_four_digits(limit.step) +
                     " s, set by: " + limit.reason);
}

void check_gain(const Case &parameters, const coupling::ExchangeGain &gain)
{
  if (gain.gain >= gain.limit)
    throw InputError(
        parameters.file + ": MembraneContact/normal_stiffness = " +
        in_four_digits(parameters.membrane_contact.normal_stiffness) +
        " N/m: exchange gain k dt^2/(4 m) = " + in_four_digits(gain.gain) +
        " must be below " + in_four_digits(gain.limit) +
        ": soften the contact, shorten the step, use a heavier membrane or "
        "Coupling/exchange = iterated");
}

void check_membrane_step(const Case &parameters, const SetupStep &setup)
{
  const CouplingParameters &c = parameters.coupling;
  const double own = c.rules.particle_steps * setup.step / c.body_steps;
  if (!c.is_body_implicit && own > setup.membrane_step)
    throw InputError(parameters.file +
                     ": Coupling/body_steps = " + std::to_string(c.body_steps) +
                     ": explicit steps of the membrane of " +
                     in_four_digits(own) + " s must be at most " +
                     in_four_digits(setup.membrane_step) +
                     " s: take more of them, or body_time = implicit");
}

/// Gains at this step, and what a pass can stand of them.
void add_gains(const Case &parameters, const MembraneNode &node,
               SetupStep &setup)
{
  const coupling::ExchangeParameters rules =
      parameters.coupling.exchange_rules();
  setup.membrane_step = node.membrane_step;
  setup.window = coupling::window_gain(node.contact, node.mass,
                                       rules.particle_steps * setup.step);
  if (rules.has_contact_tangent) // one pass has no limit of its own
    setup.window.one_pass_limit = std::numeric_limits<double>::infinity();
  if (rules.rule == coupling::ExchangeRule::every_step)
    setup.gain = coupling::exchange_gain(node.contact, {&node.mass, 1},
                                         node.membrane_step, setup.step);
  else
    setup.gain = {setup.window.gain,
                  rules.rule == coupling::ExchangeRule::one_pass
                      ? setup.window.one_pass_limit
                      : std::numeric_limits<double>::infinity()};
}
} // namespace

SetupStep choose_step(const Case &parameters, const dem::StepLimit &limit,
                      double lightest, const fem::Membrane *membrane)
{
  const bool is_fixed = parameters.time.step == StepRule::fixed;
  SetupStep setup;
  setup.cap = limit.step;
  if (is_fixed)
  {
    check_fixed(parameters, limit);
    setup.step = parameters.time.fixed_step;
  }
  else
    setup.step = parameters.time.safety * setup.cap;
  if (!membrane)
    return setup;
  const MembraneNode node = lightest_node(parameters, lightest, *membrane);
  add_gains(parameters, node, setup);
  if (is_fixed)
    check_gain(parameters, *setup.gain);
  else if (setup.gain->gain > 0.)
  {
    // The gain goes with the square of the step.
    setup.cap = std::min(setup.cap, setup.step * std::sqrt(setup.gain->limit /
                                                           setup.gain->gain));
    setup.step = parameters.time.safety * setup.cap;
    add_gains(parameters, node, setup);
  }
  check_membrane_step(parameters, setup);
  return setup;
}

namespace
{
/// That particles could make of the nominal membrane.
fem::SurfaceMesh finest_mesh(const Case &parameters)
{
  fem::SurfaceMesh mesh = lateral_mesh(parameters, dem::Vec3::Zero(),
                                       nominal_size(parameters.specimen));
  if (parameters.boundary.refined == MembraneRefinement::none)
    return mesh;
  std::vector<std::int32_t> all(mesh.quads.size());
  std::iota(all.begin(), all.end(), 0);
  return fem::halve_quads(mesh, all);
}
} // namespace

SetupStep choose_step(const Case &parameters, const dem::StepLimit &limit,
                      double lightest)
{
  std::optional<fem::Membrane> membrane;
  if (parameters.boundary.lateral == Lateral::membrane)
    membrane.emplace(parameters.membrane, finest_mesh(parameters));
  return choose_step(parameters, limit, lightest,
                     membrane ? &*membrane : nullptr);
}
} // namespace spall
