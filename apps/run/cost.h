#pragma once

#include <dem/parallel/ranks.h>
#include <dem/stopwatch.h>

#include <nlohmann/json_fwd.hpp>

#include <map>
#include <string>

namespace spall
{
using dem::processor_seconds;

/// Memory of this program.
struct MemoryUse
{
  double now = 0.;  ///< resident [bytes]
  double peak = 0.; ///< resident, highest so far [bytes]
};

MemoryUse memory_use();

/// Name of the processor time of all ranks among the times of a run, which are
/// carried over restarts together.
inline constexpr const char *processor_time = "processor";
/// The same without the preparation: cases that share a specimen can be
/// compared by it.
inline constexpr const char *loading_processor_time = "loading_processor";
/// Wall time without the preparation.
inline constexpr const char *loading_wall_time = "loading_wall_clock";

/// What all ranks have spent [s]. Collective.
double over_all_ranks(const dem::Ranks &ranks, double seconds);

/// Writes processor_s, loading_processor_s, loading_wall_clock_s, peak_memory_B
/// (of the rank that needs most) and, as wall_clock_s, the phases. Collective.
void add_cost(const dem::Ranks &ranks, std::map<std::string, double> seconds,
              nlohmann::ordered_json &summary);
} // namespace spall
