#pragma once

#include <dem/engine.h>
#include <fem/membrane.h>

namespace spall
{
/// Wall-clock of one step of stones as they lie, nothing moves, with so many
/// threads; 0: as many as are fastest [s].
double still_step_cost(dem::Engine &engine, int threads);

/// Wall-clock of one step of the membrane alone [s].
double still_step_cost(fem::Membrane &membrane);
} // namespace spall
