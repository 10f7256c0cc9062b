#pragma once

#include "bench/scene.h"

#include <functional>

namespace spall
{
/// What close_box has reached.
struct ClosedBox
{
  double time = 0.;                     ///< simulated [s]
  dem::Vec3 stress = dem::Vec3::Zero(); ///< on the walls [Pa]
  double unbalanced_ratio = 0.;         ///< unbalanced force ratio [-]
  double step = 0.;                     ///< time step taken [s]
  std::int64_t n_steps = 0;
};

/// Gets what is reached every 200 steps.
using ClosingReport = std::function<void(const ClosedBox &)>;

/// Moves the particles apart until no two can touch and closes the box round
/// them again. Without friction, and with local damping, they are pressed
/// together to three times 30 kPa; then the servo holds 30 kPa, with friction,
/// for without it particles that overlap along the branch do not come to rest
/// (docs/developer/decisions/0004-radial-overlap-at-rest.md). Small particles
/// fall into place for 0.08 s; ends when all are at rest, 0.07 s later at the
/// latest. Throws InputError if the time step is too long for the particles.
ClosedBox close_box(BenchParticles &particles, const ClosingReport &report);

/// Puts n copies of a closed box side by side along each axis, without the
/// walls between them, and has the servo hold 30 kPa until all are at rest: a
/// large packing at the price of a small one. Throws as close_box().
ClosedBox join_copies(BenchParticles &particles, int n,
                      const ClosingReport &report);
} // namespace spall
