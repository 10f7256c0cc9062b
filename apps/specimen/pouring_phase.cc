#include "specimen/pouring_phase.h"

#include <algorithm>
#include <cstdio>
#include <map>

namespace spall
{
std::string pouring_phase(const dem::Pouring &pouring, double time)
{
  using Stage = dem::Pouring::Stage;
  static const std::map<Stage, const char *> activities = {
      {Stage::waiting, "waits"},         {Stage::settling, "settles"},
      {Stage::tamping, "is tamped"},     {Stage::lifting, "is relieved"},
      {Stage::resting, "comes to rest"}, {Stage::done, "is in"}};
  char text[80];
  std::snprintf(text, sizeof text, "layer %zu of %zu %s, %.3g s",
                std::min(pouring.layers().size() + 1, pouring.n_layers()),
                pouring.n_layers(), activities.at(pouring.stage()), time);
  return text;
}
} // namespace spall
