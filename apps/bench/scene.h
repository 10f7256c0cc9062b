#pragma once

#include "specimen/packing_file.h"

#include <dem/control/box_servo.h>
#include <dem/engine.h>

#include <memory>
#include <string>
#include <vector>

namespace spall
{
/// What the particles of a benchmark do.
enum class BenchScene
{
  rest,    ///< lie in their box
  jolt,    ///< the same, then all get (0.1, 0, -0.3) m/s
  collapse ///< flow out: the wall at +x stands at 1.6 box sides
};

/// Time step of the warm-up and of the timed steps [s].
inline constexpr double bench_step = 1e-6;

/// Steps before the timed ones, for lists and caches.
inline constexpr int warm_up_steps = 200;

/// Steps of settling_step() before that: contacts find their balance on walls
/// that are not those of the packing, a collapse comes into flow (20 ms).
constexpr int settling_steps(BenchScene scene)
{
  return scene == BenchScene::collapse ? 5000 : 1500;
}

/// The particles to be timed and where they lie.
struct BenchParticles
{
  Packing packing;
  std::vector<dem::ParticleShape> bodies;
  dem::ContactGeometry geometry = dem::ContactGeometry::radial;
  std::shared_ptr<dem::Ranks> ranks = dem::one_rank();
};

/// Spheres, or particles that take the shapes of the folder in turn, their ball
/// radius that of the packing; unless the packing has orientations, they are
/// turned at random. Throws InputError.
BenchParticles make_bench_particles(Packing packing, const std::string &shapes);

/// Material, walls and gravity of the peer codes, nothing breaks. Particles
/// with shapes get a rolling friction of 0.5: at the 0.2 of the spheres they
/// keep themselves in motion
/// (docs/developer/decisions/0004-radial-overlap-at-rest.md).
dem::EngineParameters bench_parameters(const BenchParticles &particles);

/// The particles in an engine, without walls. Throws InputError if the time
/// step is too long for them.
std::unique_ptr<dem::Engine>
fill_engine(const BenchParticles &particles,
            const dem::EngineParameters &parameters);

/// The scene of the peer codes: particles and six planes, with gravity. Throws
/// as fill_engine().
std::unique_ptr<dem::Engine> make_bench_engine(const BenchParticles &particles,
                                               BenchScene scene,
                                               bool is_breaking);

/// 4e-6 s, shorter for particles of less than 5 mm [s].
double settling_step(const dem::Engine &engine);

/// Steps of settling_step(), with local damping unless the scene flows; then
/// what the scene does to the particles.
void settle(dem::Engine &engine, BenchScene scene, int n_steps);
} // namespace spall
