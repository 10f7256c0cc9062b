#pragma once

#include <dem/breakage/events.h>

#include <string>
#include <vector>

namespace spall
{
/// Header of events.csv; `progress` names the column with the progress of the
/// test: cycle_1, displacement_m, turn_1; time_s: the time alone.
std::string events_header(const std::string &progress);

/// The row of one event.
std::vector<double> event_row(const dem::BreakageEvent &event,
                              const std::string &progress, double progress_at);
} // namespace spall
