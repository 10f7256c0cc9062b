#include "dem_scene.h"

#include <dem/integrate/time_step.h>
#include <dem/measure/assembly.h>
#include <dem/measure/contact_springs.h>
#include <dem/particles/density_scaling.h>

#include <gtest/gtest.h>

#include <numbers>
#include <stdexcept>

namespace
{
using dem::Vec3;

constexpr double threshold = 8e-3; // [m]
// Products of a few numbers of double precision.
constexpr double round_off = 1e-13;

/// Linear walls that set the step.
dem::EngineParameters scaled_parameters()
{
  dem::EngineParameters p = support::bare_parameters();
  p.wall.normal_stiffness = 1e7;
  p.wall.shear_stiffness = 8.5e6;
  p.wall.friction = 0.5;
  p.wall.rolling_friction = 0.1;
  p.wall.normal_damping = p.wall.shear_damping = 0.3;
  p.surface = p.wall;
  p.density_scaling_diameter = threshold;
  return p;
}

double sphere_volume(double diameter)
{
  return std::numbers::pi / 6. * diameter * diameter * diameter;
}
} // namespace

TEST(DensityScaling, FactorIsThatOfTheVolumes)
{
  EXPECT_NEAR(dem::density_scaling(2e-3, threshold), 64., 64. * round_off);
  EXPECT_EQ(dem::density_scaling(threshold, threshold), 1.);
  EXPECT_EQ(dem::density_scaling(0.02, threshold), 1.);
  EXPECT_EQ(dem::density_scaling(2e-3, 0.), 1.);
}

// The limits of the program for the lightest particle, on one wall and in a
// corner, become those of a particle of the threshold.
TEST(DensityScaling, StepIsThatOfTheThreshold)
{
  dem::Engine scaled(scaled_parameters());
  support::add_sphere(scaled, 0.5 * 3e-3, Vec3::Zero());
  support::add_sphere(scaled, 0.5 * 5e-3, Vec3(0.1, 0., 0.));
  support::add_sphere(scaled, 0.5 * 20e-3, Vec3(0.2, 0., 0.));
  dem::EngineParameters p = scaled_parameters();
  p.density_scaling_diameter = 0.;
  dem::Engine plain(p);
  support::add_sphere(plain, 0.5 * threshold, Vec3::Zero());
  support::add_sphere(plain, 0.5 * 20e-3, Vec3(0.2, 0., 0.));

  const dem::StepLimit limit =
      dem::critical_step(plain.parameters(), plain.particles());
  EXPECT_EQ(limit.reason,
            "lightest particle on a wall (Wall/normal_stiffness)");
  EXPECT_NEAR(dem::critical_step(scaled.parameters(), scaled.particles()).step,
              limit.step, round_off * limit.step);
  const double corner = dem::corner_step(plain.parameters(), plain.particles());
  EXPECT_NEAR(dem::corner_step(scaled.parameters(), scaled.particles()), corner,
              round_off * corner);
}

// With soft walls and Hertz contacts the Rayleigh wave is left: no shorter than
// that of the threshold.
TEST(DensityScaling, RayleighStepIsNoShorterThanThatOfTheThreshold)
{
  dem::EngineParameters p = scaled_parameters();
  p.wall.normal_stiffness = p.wall.shear_stiffness = 1.;
  p.surface = p.wall;
  const auto step_of = [&p](double diameter)
  {
    dem::Engine engine(p);
    support::add_sphere(engine, 0.5 * diameter, Vec3::Zero());
    return dem::critical_step(engine.parameters(), engine.particles()).step;
  };
  EXPECT_NEAR(step_of(2e-3), 2. * step_of(threshold),
              round_off * step_of(threshold));
}

// Of a shape that is no sphere, too, also after it has lost some of its volume.
TEST(DensityScaling, SolidMassStaysThatOfTheVolume)
{
  const dem::ParticleShape shape = dem::make_sphere(0.5 * 4e-3);
  dem::ParticleSystem particles;
  particles.add(shape, Vec3::Zero(), dem::Quaternion::Identity(), 2750., 8.);
  const double solid = 2750. * sphere_volume(4e-3);
  EXPECT_NEAR(particles.mass(0), 8. * solid, 8. * solid * round_off);
  EXPECT_NEAR(particles.inertia(0), 0.4 * 8. * solid * 4e-6,
              solid * 4e-6 * round_off);
  EXPECT_NEAR(particles.solid_mass(0), solid, solid * round_off);
  EXPECT_NEAR(particles.initial_mass[0], solid, solid * round_off);
  EXPECT_EQ(dem::abrasion(particles, *dem::one_rank()), 0.);

  particles.shape[0] = dem::make_sphere(0.5 * 3.9e-3);
  particles.update_mass(0, 2750.);
  const double left = 2750. * sphere_volume(3.9e-3);
  EXPECT_NEAR(particles.mass(0), 8. * left, 8. * left * round_off);
  EXPECT_NEAR(dem::abrasion(particles, *dem::one_rank()), 1. - left / solid,
              round_off);
}

// A sphere that leaves a linear wall after half a period pi sqrt(m / k) has
// the mass that its energy is of.
TEST(DensityScaling, EngineAcceleratesTheScaledMass)
{
  dem::EngineParameters p = support::bare_parameters();
  p.wall.normal_stiffness = 1e6;
  p.wall.shear_stiffness = 0.;
  p.density_scaling_diameter = threshold;
  dem::Engine engine(p);
  support::add_sphere(engine, 0.5 * 4e-3, Vec3(0., 0., 2e-3 + 1e-9));
  dem::add_plane(engine, Vec3::Zero(), Vec3::UnitZ());
  const double mass = p.particle.density * sphere_volume(threshold);
  engine.particles().velocity(0).z() = -0.1;
  EXPECT_NEAR(engine.energy().kinetic, 0.5 * mass * 0.01, 1e-12);
  const double half_period = std::numbers::pi * std::sqrt(mass / 1e6);
  const double dt = 1e-4 * half_period;
  double begin = 0., end = 0.;
  while (end == 0. && engine.time() < 3. * half_period)
  {
    engine.advance(dt);
    const bool is_in_contact = engine.particles().position(0).z() < 2e-3;
    if (is_in_contact && begin == 0.)
      begin = engine.time();
    if (!is_in_contact && begin > 0.)
      end = engine.time();
  }
  // Both instants are known to a step.
  EXPECT_NEAR(end - begin, half_period, 3. * dt);
}

TEST(DensityScaling, CountsAndAddedMass)
{
  dem::Engine engine(scaled_parameters());
  support::add_sphere(engine, 0.5 * 4e-3, Vec3::Zero());
  support::add_sphere(engine, 0.5 * threshold, Vec3(0.1, 0., 0.));
  const dem::DensityScaling found = dem::density_scaling_of(engine.particles());
  EXPECT_EQ(found.n_scaled, 1u);
  EXPECT_NEAR(found.largest_factor, 8., 8. * round_off);
  // Solids of 1/8 and 1 that are accelerated as 1 and 1.
  EXPECT_NEAR(found.added_mass, (2. - 1.125) / 1.125, round_off);
}

TEST(DensityScaling, IsRefusedWithGravity)
{
  dem::EngineParameters p = scaled_parameters();
  p.gravity = Vec3(0., 0., -9.81);
  EXPECT_THROW(dem::Engine{p}, std::invalid_argument);
}
