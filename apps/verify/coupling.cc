#include "families.h"

#include <coupling/exchange.h>
#include <coupling/rigid_body.h>
#include <coupling/solid_body.h>
#include <dem/engine_boundaries.h>

#include <cmath>

// Particles and bodies that move each other.
namespace spall::verify
{
namespace
{
constexpr double gravity = 9.81;

/// Springs only; boundaries of stiffness `k`.
dem::EngineParameters bare(double k)
{
  dem::EngineParameters p;
  p.breakage.is_active = false;
  p.geometry.wall_geometry = dem::ContactGeometry::radial;
  p.surface.normal_stiffness = k;
  p.surface.shear_stiffness = 0.85 * k;
  p.surface.friction = 0.;
  p.surface.normal_damping = p.surface.shear_damping = 0.;
  return p;
}

coupling::CoupledParticles alone(dem::Engine &engine)
{
  static const coupling::ShapeLibrary none;
  return coupling::particles_of(engine, none);
}

/// One quad of the plane z = 0 round the origin, outside is +z.
fem::SurfaceMesh square(double side)
{
  const double half = 0.5 * side;
  return {{{-half, -half, 0.},
           {half, -half, 0.},
           {half, half, 0.},
           {-half, half, 0.}},
          {{0, 1, 2, 3}}};
}

void add_ball(dem::Engine &engine, double radius, const dem::Vec3 &position)
{
  engine.add_particle(dem::make_sphere(radius), position,
                      dem::Quaternion::Identity());
}

/// A wall of speed V under a sphere at rest: f g t while it slides, 2 V / 7
/// when it rolls.
std::vector<Row> moving_wall()
{
  const double speed = 0.5, friction = 0.2, radius = 0.01, k = 1e5;
  const double slip = 2. * speed / (7. * friction * gravity);
  dem::EngineParameters p = bare(k);
  p.surface.friction = friction;
  p.surface.normal_damping = p.surface.shear_damping = 0.5;
  p.gravity = {0., 0., -gravity};
  dem::Engine engine(p);
  add_ball(engine, radius, {0., 0., radius});
  const double mass = engine.particles().mass(0);
  engine.particles().position(0).z() -= mass * gravity / k;
  coupling::ExchangeParameters rules;
  rules.rule = coupling::ExchangeRule::one_pass;
  rules.particle_steps = 10;
  coupling::Exchange exchange(rules);
  const fem::SurfaceMesh mesh = square(1.);
  fem::PlateBodyParameters held;
  held.moves = held.turns = {false, false, false};
  coupling::RigidDrive drive;
  drive.path = [speed](double time) { return dem::Vec3(speed * time, 0., 0.); };
  exchange.add(std::make_unique<coupling::RigidBody>(held, mesh.nodes, drive),
               mesh, "wall", p.surface, coupling::ParticleSide::outside,
               engine);
  const long n = std::lround(slip / std::sqrt(mass / k));
  double sliding = 0.;
  for (long window = 0; window < 2 * n; ++window)
  {
    exchange.advance(alone(engine), slip / double(n));
    if (2 * (window + 1) == n || 2 * window + 1 == n)
      sliding = engine.particles().velocity(0).x() / engine.time();
  }
  // The springs take some steps to stick and to slip.
  return {{"acceleration while it slides", "m/s^2", friction * gravity, sliding,
           5e-3},
          {"speed when it rolls", "m/s", 2. / 7. * speed,
           engine.particles().velocity(0).x(), 3e-3},
          at_most("interface energy error / work that crossed", "-",
                  exchange.ledger().work_residual(), 1e-11)};
}

/// A soft block on four springs: they carry its weight, the block in implicit
/// steps, windows iterated.
std::vector<Row> block_on_balls()
{
  const double side = 0.1, k = 2450., density = 1000., radius = 0.01;
  dem::EngineParameters p = bare(k);
  p.surface.normal_damping = 0.5;
  p.particle.density = 1e9; // nothing moves the balls
  dem::Engine engine(p);
  for (const double x : {0.25 * side, 0.75 * side})
    for (const double y : {0.25 * side, 0.75 * side})
      add_ball(engine, radius, {x, y, -radius});
  fem::SolidParameters solid;
  solid.layers = {{1e6, 0.3, density}};
  fem::BoxMesh box;
  box.widths.fill({0.5 * side, 0.5 * side});
  auto body = std::make_unique<coupling::SolidBody>(
      fem::Solid(solid, fem::box_mesh(box)), fem::z_lower,
      coupling::BodySteps{true, 1});
  const fem::SurfaceMesh mesh = body->mesh();
  coupling::Field weight;
  for (const double mass : body->solid().nodal_mass())
    weight.push_back(-gravity * mass * dem::Vec3::UnitZ());
  body->set_dead_load(weight);
  coupling::ExchangeParameters rules;
  rules.rule = coupling::ExchangeRule::iterated;
  rules.particle_steps = 5;
  rules.tolerance = 1e-11;
  coupling::Exchange exchange(rules);
  exchange.add(std::move(body), mesh, "block", p.surface,
               coupling::ParticleSide::outside, engine);
  for (int window = 0; window < 1000; ++window)
    exchange.advance(alone(engine), 5e-4);
  double overlap = 0.;
  for (std::size_t c = 0; c < dem::on_facets(engine).size(); ++c)
    overlap += 0.25 * dem::on_facets(engine).overlap[c];
  const double sunk = density * std::pow(side, 3) * gravity / (4. * k);
  // What is left of the swing after half a second.
  return {{"overlap of a ball at rest", "m", sunk, overlap, 1e-3},
          at_most("interface impulse error / impulse that crossed", "-",
                  exchange.ledger().impulse_residual(), 1e-12)};
}
} // namespace

Family coupling()
{
  return {"coupling",
          "Particles and bodies together.",
          {{"sphere on a moving wall, windows of 10 steps",
            "f g; 2 V / 7 (Coulomb, solid sphere)", moving_wall},
           {"block of 1 MPa on four balls, iterated", "M g / (4 k)",
            block_on_balls}}};
}
} // namespace spall::verify
