#pragma once

#include <dem/engine.h>

#include <nlohmann/json.hpp>

namespace spall
{
/// Adds `contact_places` to a summary: what became of contacts that follow the
/// true surfaces. Nothing if none do.
inline void add_contact_places(const dem::Engine &engine,
                               nlohmann::ordered_json &summary)
{
  if (!engine.particles().follows_surfaces)
    return;
  const dem::ContactPointEvents &places = engine.contact_point_events();
  summary["contact_places"] = {
      {"searches", places.n_scans},  {"found_late", places.n_late},
      {"jumped", places.n_jumps},    {"ended", places.n_ended},
      {"merged", places.n_merged},   {"not_listed", places.n_unlisted},
      {"led_nowhere", places.n_lost}};
}
} // namespace spall
