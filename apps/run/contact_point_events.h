#pragma once

#include <dem/measure/totals.h>

#include <nlohmann/json.hpp>

namespace spall
{
/// Adds `contact_point_events` to a summary: what became of contacts that
/// follow the true surfaces, of all ranks. Nothing if none do. Collective.
inline void add_contact_point_events(const dem::Engine &engine,
                                     nlohmann::ordered_json &summary)
{
  if (!engine.particles().follows_surfaces)
    return;
  const dem::ContactPointEvents events =
      dem::total_contact_point_events(engine);
  summary["contact_point_events"] = {
      {"searches", events.n_scans},  {"found_late", events.n_late},
      {"jumped", events.n_jumps},    {"ended", events.n_ended},
      {"merged", events.n_merged},   {"not_listed", events.n_unlisted},
      {"led_nowhere", events.n_lost}};
}
} // namespace spall
