#include "coupled_scene.h"

#include <dem/engine_boundaries.h>

#include <gtest/gtest.h>

// A light plate under a ball that presses on it, driven to and fro so that it
// sticks and slides: spring and dashpot of shear together are never above the
// Coulomb limit, and windows settle where sliding begins.
namespace
{
constexpr double normal_force = 10., friction = 0.3, stiffness = 1e6,
                 plate_mass = 1e-3;

struct Outcome
{
  std::int64_t n_unsettled = 0;
  double passes = 0.;     ///< per window [-]
  double slid = 0.;       ///< dissipated by friction [J]
  double most_shear = 0.; ///< tangential force on the plate [N]
};

Outcome slide(double damping)
{
  constexpr double radius = 0.05, window = 1e-5;
  dem::EngineParameters p = support::bare_parameters();
  p.particle.density = 1e12; // stays where it is
  const double particle_mass =
      p.particle.density * 4. / 3. * M_PI * std::pow(radius, 3);
  p.surface.normal_stiffness = p.surface.shear_stiffness = stiffness;
  p.surface.friction = friction;
  p.surface.shear_damping = damping * std::sqrt(plate_mass / particle_mass);
  dem::Engine engine(p);
  support::add_sphere(engine, radius,
                      {0., 0., radius - normal_force / stiffness});
  coupling::ExchangeParameters rules;
  rules.rule = coupling::ExchangeRule::iterated;
  rules.tolerance = 1e-13;
  coupling::Exchange exchange(rules);
  fem::PlateBodyParameters plate = support::upright(plate_mass);
  plate.moves = {true, false, false};
  coupling::RigidDrive drive;
  drive.load = [](double time)
  {
    fem::PlateLoad load;
    load.force.x() = 1.3 * friction * normal_force * std::sin(17e3 * time);
    return load;
  };
  const fem::SurfaceMesh mesh = support::square_at(0.1, 0.);
  exchange.add(std::make_unique<coupling::RigidBody>(plate, mesh.nodes, drive),
               mesh, "plate", p.surface, coupling::ParticleSide::outside,
               engine);
  const auto particles = coupling::particles_of(engine, support::no_shapes());
  Outcome seen;
  for (int k = 0; k < 6000; ++k)
  {
    exchange.advance(particles, window);
    double shear = 0.;
    for (const dem::Vec3 &load : dem::surface(engine).load)
      shear += load.x();
    seen.most_shear = std::max(seen.most_shear, std::abs(shear));
  }
  seen.n_unsettled = exchange.n_unsettled();
  seen.passes = double(exchange.n_passes()) / double(exchange.n_windows());
  seen.slid = engine.energy().friction;
  return seen;
}
} // namespace

TEST(Sliding, ShearStaysWithinFriction)
{
  for (const double damping : {0., 0.1, 0.5})
  {
    const Outcome seen = slide(damping);
    EXPECT_EQ(seen.n_unsettled, 0) << damping;
    EXPECT_LT(seen.passes, 2.) << damping;
    EXPECT_GT(seen.slid, 1e-2) << damping;
    // With a dashpot that rests only while it slides: up to 5.4 N.
    EXPECT_NEAR(seen.most_shear, friction * normal_force, 1e-9 * normal_force)
        << damping;
  }
}
