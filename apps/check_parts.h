#pragma once

#include "specimen.h"

namespace spall
{
/// Lines of spall check.
void print_memory(); ///< resident now
void print_stones(const dem::Engine &engine);
/// The gain that counts, what the ways of exchange stand, and which to take;
/// `body`: what the stones exchange with.
void print_exchange(const SetupStep &setup, const char *body);

/// Of a case of kind subgrade: scene, step, exchange, memory, time.
void check_subgrade_cost(const Case &parameters);
} // namespace spall
