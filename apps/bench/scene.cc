#include "bench/scene.h"

#include "bench/state.h"
#include "case/gravity.h"
#include "case/parameter.h"
#include "errors.h"
#include "shape/file.h"

#include <dem/parallel/distribution.h>
#include <dem/random.h>

#include <algorithm>
#include <array>
#include <limits>

namespace spall
{
namespace
{

/// The peers' material: E = 1.25e9 Pa, nu = 0.25, so G = E / (2 (1 + nu)) =
/// 5e8 Pa. Restitution e = 0.4 from contact to zero overlap, as the peer
/// LIGGGHTS takes it: its dashpot 2 sqrt(5/6) b sqrt(k m*) with
/// b = |ln e| / sqrt(pi^2 + ln^2 e) is ours with beta = sqrt(5/6) b = 0.2556.
dem::ParticleMaterial particle_material()
{
  dem::ParticleMaterial particle;
  particle.density = 2750.;
  particle.shear_modulus = 5e8;
  particle.poisson_ratio = 0.25;
  particle.friction = 0.5;
  particle.rolling_friction = 0.2;
  particle.normal_damping = particle.shear_damping = 0.2556;
  return particle;
}

/// Linear walls in place of the peers' Hertz walls: k_n such that all wall
/// contacts of the peers' packings together press as hard (sum of the Hertz
/// forces over the sum of the overlaps, 2.90e5 and 2.86e5 N/m), k_s / k_n =
/// 9/7 as Mindlin to the secant of Hertz at nu = 1/4, beta = b above. A
/// sphere of 5 mm diameter, 0.18 g, is stable on it up to 2e-5 s.
dem::WallMaterial wall_material()
{
  dem::WallMaterial wall;
  wall.normal_stiffness = 2.9e5;
  wall.shear_stiffness = 9. / 7. * wall.normal_stiffness;
  wall.friction = 0.5;
  wall.rolling_friction = 0.2;
  wall.normal_damping = wall.shear_damping = 0.28;
  return wall;
}

/// That of the particles of all ranks.
dem::StepLimit step_limit(const dem::Engine &engine)
{
  dem::StepLimit limit{std::numeric_limits<double>::infinity(), ""};
  if (engine.particles().n_owned() > 0)
    limit = dem::critical_step(engine.parameters(), engine.particles());
  std::array rate{1. / limit.step};
  engine.distribution().ranks().max(rate);
  limit.step = 1. / rate[0];
  return limit;
}

void require_stable(const dem::Engine &engine)
{
  const dem::StepLimit limit = step_limit(engine);
  if (bench_step > limit.step)
    throw InputError("bench: the time step of " + number_text(bench_step) +
                     " s must be at most " + number_text(limit.step) +
                     " s for these particles, set by: " + limit.reason);
}
} // namespace

dem::EngineParameters bench_parameters(const BenchParticles &particles)
{
  dem::EngineParameters parameters;
  parameters.particle = particle_material();
  if (particles.bodies.front().series)
    parameters.particle.rolling_friction = 0.5;
  parameters.wall = parameters.surface = wall_material();
  parameters.gravity = -gravity * dem::Vec3::UnitZ();
  parameters.geometry.geometry = particles.geometry;
  parameters.geometry.usual_skin = 5e-4;  // the skin of the peers
  parameters.geometry.overlap.stop = 1e9; // shapes begin deep in each other
  parameters.breakage.is_active = false;
  return parameters;
}

std::unique_ptr<dem::Engine>
fill_engine(const BenchParticles &particles,
            const dem::EngineParameters &parameters)
{
  auto engine = std::make_unique<dem::Engine>(parameters, particles.ranks);
  const Packing &packing = particles.packing;
  for (std::size_t k = 0; k < packing.size(); ++k)
    engine->add_particle(particles.bodies[k], packing.position[k],
                         packing.orientation.empty()
                             ? dem::Quaternion::Identity()
                             : packing.orientation[k]);
  require_stable(*engine);
  return engine;
}

BenchParticles make_bench_particles(Packing packing, const std::string &shapes)
{
  BenchParticles particles;
  std::vector<dem::ParticleShape> unit;
  if (!shapes.empty())
    for (const ShapeFile &shape : read_shapes(shapes))
      unit.push_back(dem::make_shape(
          std::make_shared<const dem::Coefficients>(shape.coefficients), 1.));
  for (std::size_t k = 0; k < packing.size(); ++k)
    particles.bodies.push_back(
        unit.empty() ? dem::make_sphere(packing.radius[k])
                     : dem::resized(unit[k % unit.size()], packing.radius[k]));
  if (!unit.empty() && packing.orientation.empty())
  {
    dem::Random random(1);
    for (std::size_t k = 0; k < packing.size(); ++k)
      packing.orientation.push_back(random.rotation());
  }
  particles.packing = std::move(packing);
  return particles;
}

std::unique_ptr<dem::Engine> make_bench_engine(const BenchParticles &particles,
                                               BenchScene scene,
                                               bool is_breaking)
{
  dem::EngineParameters parameters = bench_parameters(particles);
  parameters.breakage.is_active = is_breaking;
  std::unique_ptr<dem::Engine> engine = fill_engine(particles, parameters);
  dem::Vec3 upper = particles.packing.box;
  if (scene == BenchScene::collapse)
    upper.x() *= 1.6;
  dem::add_box(*engine, dem::Vec3::Zero(), upper);
  return engine;
}

double settling_step(const dem::Engine &engine)
{
  return std::min(4e-6, 0.2 * step_limit(engine).step);
}

void settle(dem::Engine &engine, BenchScene scene, int n_steps)
{
  const double step = settling_step(engine);
  engine.set_local_damping(scene == BenchScene::collapse ? 0. : 0.7);
  for (int k = 0; k < n_steps; ++k)
    engine.advance(step);
  engine.set_local_damping(0.);
  if (scene == BenchScene::jolt)
  {
    dem::ParticleSystem &particles = engine.particles();
    for (std::size_t k = 0; k < particles.n_owned(); ++k)
      particles.velocity(k) = {0.1, 0., -0.3};
  }
}
} // namespace spall
