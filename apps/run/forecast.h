#pragma once

#include <dem/engine.h>
#include <fem/membrane.h>

namespace spall
{
/// Wall-clock of one step of stones as they lie, nothing moves [s].
double still_step_cost(dem::Engine &engine);

/// Wall-clock of one step of the membrane alone [s].
double still_step_cost(fem::Membrane &membrane);
} // namespace spall
