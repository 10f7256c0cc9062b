#include "strike.h"

#include "reference_impacts.h"
#include "scenes.h"

#include <algorithm>
#include <cmath>

namespace spall::verify
{
namespace
{
dem::EngineParameters parameters_of(const BallMaterial &ball)
{
  dem::EngineParameters p = bare_parameters();
  p.particle.density = ball.density;
  p.particle.shear_modulus = ball.shear_modulus;
  p.particle.poisson_ratio = ball.poisson_ratio;
  p.particle.friction = ball.friction;
  p.friction_limit = ball.friction_limit;
  p.particle.normal_damping = damping_of(ball.restitution);
  return p;
}

/// Sum of both radii less the distance [m].
double overlap_of(const dem::ParticleSystem &balls)
{
  return balls.radius(0) + balls.radius(1) -
         (balls.position(1) - balls.position(0)).norm();
}

dem::Vec3 momentum_of(const dem::ParticleSystem &balls)
{
  return balls.mass(0) * balls.velocity(0) + balls.mass(1) * balls.velocity(1);
}

/// Runs the impact until the balls part.
Rebound run_impact(dem::Engine &engine, double time_step)
{
  const dem::ParticleSystem &balls = engine.particles();
  Rebound rebound;
  double overlap = 0., before = 0.;
  do
  {
    before = overlap;
    engine.advance(time_step);
    overlap = overlap_of(balls);
    rebound.peak_overlap = std::max(rebound.peak_overlap, overlap);
    rebound.peak_force =
        std::max(rebound.peak_force, balls.load[0].force.norm());
  } while (overlap > 0.);
  rebound.duration = engine.time() + time_step * overlap / (before - overlap);
  rebound.velocity = balls.velocity(0);
  rebound.spin = balls.spin(0);
  rebound.damped = engine.energy().damping;
  rebound.momentum = momentum_of(balls);
  return rebound;
}

void add_missile(dem::Engine &engine, const Missile &missile)
{
  add_sphere(engine, missile.radius, {-missile.radius, 0., 0.});
  engine.particles().velocity(0) = missile.velocity;
  engine.particles().spin(0) = missile.spin;
}
} // namespace

BallMaterial elastic_ball(double density, double young_modulus,
                          double poisson_ratio)
{
  BallMaterial ball;
  ball.density = density;
  ball.shear_modulus = 0.5 * young_modulus / (1. + poisson_ratio);
  ball.poisson_ratio = poisson_ratio;
  return ball;
}

double damping_of(double restitution)
{
  double low = 0., high = 5.;
  for (int step = 0; step < 60; ++step)
  {
    const double middle = 0.5 * (low + high);
    const bool is_too_weak = reference::hertz_restitution(middle) > restitution;
    (is_too_weak ? low : high) = middle;
  }
  return restitution < 1. ? 0.5 * (low + high) : 0.;
}

Rebound strike_ball(const Missile &missile, const Target &target,
                    double time_step)
{
  // Both E* and G* of two alike bodies of modulus g are those of G and s G if
  // 2 / g = (1 + 1 / s) / G.
  BallMaterial alike = missile.material;
  alike.shear_modulus *= 2. / (1. + 1. / target.stiffening);
  dem::Engine engine(parameters_of(alike));
  add_missile(engine, missile);
  add_sphere(engine, target.radius, {target.radius, 0., 0.});
  engine.particles().mass(1) *= target.mass_factor;
  engine.particles().inertia(1) *= target.mass_factor;
  return run_impact(engine, time_step);
}

Rebound strike_plane(const Missile &missile, double time_step)
{
  return strike_ball(missile, {1e4 * missile.radius, 1., 1e300}, time_step);
}

Rebound strike_image(const Missile &missile, double time_step)
{
  dem::Engine engine(parameters_of(missile.material));
  add_missile(engine, missile);
  add_sphere(engine, missile.radius, {missile.radius, 0., 0.});
  engine.particles().velocity(1) = -missile.velocity;
  engine.particles().spin(1) = missile.spin;
  return run_impact(engine, time_step);
}
} // namespace spall::verify
