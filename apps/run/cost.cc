#include "run/cost.h"

#include <dem/parallel/rank_sums.h>

#include <nlohmann/json.hpp>

#include <array>
#include <fstream>
#include <limits>

namespace spall
{
MemoryUse memory_use()
{
  MemoryUse use;
  std::ifstream status("/proc/self/status");
  for (std::string key; status >> key;)
  {
    if (key == "VmRSS:" && status >> use.now)
      use.now *= 1024.;
    else if (key == "VmHWM:" && status >> use.peak)
      use.peak *= 1024.;
    status.ignore(std::numeric_limits<std::streamsize>::max(), '\n');
  }
  return use;
}

double over_all_ranks(const dem::Ranks &ranks, double seconds)
{
  std::array<dem::ExactSum, 1> sum;
  sum[0].add(seconds);
  dem::sum_over_ranks(ranks, sum);
  return sum[0].value();
}

void add_cost(const dem::Ranks &ranks, std::map<std::string, double> seconds,
              nlohmann::ordered_json &summary)
{
  std::array peak{memory_use().peak};
  ranks.max(peak);
  summary["processor_s"] = seconds[processor_time];
  summary["loading_processor_s"] = seconds[loading_processor_time];
  summary["loading_wall_clock_s"] = seconds[loading_wall_time];
  summary["peak_memory_B"] = peak[0];
  seconds.erase(processor_time);
  seconds.erase(loading_processor_time);
  seconds.erase(loading_wall_time);
  summary["wall_clock_s"] = seconds;
}
} // namespace spall
