#pragma once

#include "case.h"

namespace spall::verify
{
// breakage_engine.cc
std::vector<Row> press_on_walls();
std::vector<Row> press_of_particles();
std::vector<Row> energy_balance();
std::vector<Row> choices();
} // namespace spall::verify
