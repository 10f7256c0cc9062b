#include "motion_kernels.h"

#include <dem/instruction_set.h>
#include <dem/integrate/verlet.h>

#include <algorithm>
#include <cmath>

namespace dem
{
namespace
{
static_assert(sizeof(TurningFrame) == kernel::frame_row * sizeof(double));

/// Particles that one thread moves in turn, and how many are worth threads:
/// those that a thread loads and moves are still in its cache.
constexpr std::int64_t range = 16, n_worth_threads = 256;

template <class Row>
double *numbers(std::vector<Row> &rows)
{
  return rows.empty() ? nullptr : reinterpret_cast<double *>(rows.data());
}

/// The kick alone.
kernel::Motion motion_of(ParticleSystem &particles,
                         const KickParameters &parameters, double time_step,
                         WorkColumns &work)
{
  const Vec3 &g = parameters.gravity;
  return {numbers(particles.state),
          numbers(particles.load),
          numbers(particles.frame),
          particles.has_shapes ? particles.path_length.data() : nullptr,
          particles.turns_as_tensor(),
          parameters.local_damping > 0. ? work.damped.data() : nullptr,
          parameters.has_gravity() ? work.lifted.data() : nullptr,
          {g.x(), g.y(), g.z()},
          parameters.local_damping,
          0.,
          0.,
          time_step,
          0.};
}

Speeds move_all(const kernel::Motion &motion, std::size_t n_particles)
{
  const auto n = static_cast<std::int64_t>(n_particles);
  const kernel::MotionLoop loop = kernel::motion_loop();
  double moving = 0., closing = 0., check = 0.;
#pragma omp parallel for schedule(static)                                      \
    reduction(max                                                              \
              : moving, closing) reduction(+ : check) if (n >= n_worth_threads)
  for (std::int64_t first = 0; first < n; first += range)
  {
    const kernel::Fastest fastest =
        loop(motion, first, std::min(first + range, n));
    moving = std::max(moving, fastest.moving);
    closing = std::max(closing, fastest.closing);
    check += fastest.check; // zeros: in any order the same
  }
  moving = std::sqrt(moving);
  return {moving, std::max(closing, moving), std::isfinite(check)};
}
} // namespace

kernel::MotionLoop kernel::motion_loop()
{
  const InstructionSet set = instruction_set();
  return set == InstructionSet::avx512 ? avx512::motion_loop
         : set == InstructionSet::avx2 ? avx2::motion_loop
                                       : baseline::motion_loop;
}

Speeds kick_and_drift(ParticleSystem &particles, const StartOfStep &start,
                      WorkColumns &work)
{
  kernel::Motion motion =
      motion_of(particles, start.kick, 0.5 * start.time_step, work);
  motion.steepness = start.steepness;
  motion.owed = start.owed;
  motion.drift = start.time_step;
  return move_all(motion, particles.n_owned());
}

void kick(ParticleSystem &particles, const KickParameters &parameters,
          double time_step, WorkColumns &work)
{
  move_all(motion_of(particles, parameters, time_step, work),
           particles.n_owned());
}
} // namespace dem
