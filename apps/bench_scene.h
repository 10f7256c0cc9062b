#pragma once

#include "packing_file.h"

#include <dem/boundary/box_servo.h>
#include <dem/engine.h>

#include <memory>
#include <string>
#include <vector>

namespace spall
{
/// What the stones of a benchmark do.
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

/// The stones to be timed and where they lie.
struct BenchStones
{
  Packing packing;
  std::vector<dem::Body> bodies;
};

/// Spheres, or stones that take the shapes of the folder in turn, their ball
/// radius that of the packing; unless the packing has orientations, they are
/// turned at random. Throws InputError.
BenchStones make_bench_stones(Packing packing, const std::string &shapes);

/// What close_box has reached.
struct ClosedBox
{
  dem::Vec3 stress = dem::Vec3::Zero(); ///< on the walls [Pa]
  double unbalanced_ratio = 0.;         ///< unbalanced force ratio [-]
  double step = 0.;                     ///< time step taken [s]
  std::int64_t n_steps = 0;
};

/// Moves the stones apart until no two can touch and closes the box round them
/// again, without friction, rolling resistance and gravity and with local
/// damping, until the walls bear 30 kPa and the stones are at rest or 40 000
/// steps are over. Throws InputError if the step is too long for the stones.
ClosedBox close_box(BenchStones &stones);

/// The scene of the peer codes: stones and six planes, with gravity. Throws
/// InputError if the time step is too long for the stones.
std::unique_ptr<dem::Engine> make_bench_engine(const BenchStones &stones,
                                               BenchScene scene,
                                               bool is_breaking);

/// 4e-6 s, shorter for stones of less than 5 mm [s].
double settling_step(const dem::Engine &engine);

/// What the scene does to the stones after they have settled.
void start_scene(dem::Engine &engine, BenchScene scene);
} // namespace spall
