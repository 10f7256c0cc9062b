#pragma once

#include "report/chart.h"
#include "report/run_data.h"

#include <span>

namespace spall
{
/// Roundness of the particles from roundness_50s.csv and so on: all times of
/// one run, or the last of several. A note where there is none.
Chart roundness_chart(std::span<const RunData> runs);
} // namespace spall
