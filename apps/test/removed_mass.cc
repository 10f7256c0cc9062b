#include "test/removed_mass.h"

#include <dem/binary.h>
#include <dem/engine_boundaries.h>

#include <nlohmann/json.hpp>

#include <string>

namespace spall
{
namespace
{
std::string name_of(const dem::Engine &engine,
                    std::span<const NamedBoundary> named, int kind,
                    std::int64_t other)
{
  if (kind == 0)
    return "particles";
  for (const dem::FacetBoundary &facets : dem::all_facets(engine))
    if (facets.event_kind() == kind && facets.event_other(0) == other)
      return facets.label;
  for (const NamedBoundary &one : named)
    if ((kind == 1 && one.kind == BoundaryKind::plane &&
         static_cast<std::int64_t>(one.number) == other) ||
        (kind == 3 && one.kind == BoundaryKind::drum))
      return one.name;
  const std::string name = kind == 1   ? "plane"
                           : kind == 2 ? "surface"
                           : kind == 3 ? "drum"
                                       : "boundary";
  return other < 0 ? name : name + "_" + std::to_string(other);
}
} // namespace

void RemovedMass::add(std::span<const dem::BreakageEvent> events,
                      double density)
{
  for (const dem::BreakageEvent &event : events)
    masses[{event.kind, event.kind == 0 ? -1 : event.other}] +=
        event.removed_volume * density;
}

double RemovedMass::on(int kind, std::int64_t other) const
{
  const auto found = masses.find({kind, other});
  return found == masses.end() ? 0. : found->second;
}

void RemovedMass::summarise(const dem::Engine &engine,
                            std::span<const NamedBoundary> named,
                            nlohmann::ordered_json &summary) const
{
  for (const auto &[on, mass] : masses)
    summary["removed_mass_kg"][name_of(engine, named, on.first, on.second)] =
        mass;
}

void RemovedMass::save(std::ostream &out) const
{
  dem::write_value(out, static_cast<std::uint64_t>(masses.size()));
  for (const auto &[on, mass] : masses)
  {
    dem::write_value(out, on.first);
    dem::write_value(out, on.second);
    dem::write_value(out, mass);
  }
}

void RemovedMass::restore(std::istream &in)
{
  std::uint64_t n = 0;
  dem::read_value(in, n);
  masses.clear();
  for (std::uint64_t k = 0; k < n; ++k)
  {
    std::pair<int, std::int64_t> on;
    dem::read_value(in, on.first);
    dem::read_value(in, on.second);
    dem::read_value(in, masses[on]);
  }
}
} // namespace spall
