#include "run/cost.h"

#include <nlohmann/json.hpp>

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

void add_cost(std::map<std::string, double> seconds,
              nlohmann::ordered_json &summary)
{
  summary["processor_s"] = seconds[processor_time];
  summary["loading_processor_s"] = seconds[loading_processor_time];
  summary["loading_wall_clock_s"] = seconds[loading_wall_time];
  summary["peak_memory_B"] = memory_use().peak;
  seconds.erase(processor_time);
  seconds.erase(loading_processor_time);
  seconds.erase(loading_wall_time);
  summary["wall_clock_s"] = seconds;
}
} // namespace spall
