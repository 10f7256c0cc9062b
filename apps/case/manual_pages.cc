#include "case/manual_pages.h"

#include <algorithm>

namespace spall
{
namespace
{
/// One line for each section. A page that moves is corrected here.
const std::vector<ManualPages> all_pages = {
    {"Case", "case"},
    {"Material", "case"},
    {"Output", "case"},
    {"Run", "case"},
    {"Particle", "particle", {"theory/shape.md", "theory/contact.md"}},
    {"Wall", "contact", {"theory/contact.md", "theory/walls.md"}},
    {"MembraneContact", "contact", {"theory/contact.md", "theory/membrane.md"}},
    {"Contact", "contact", {"theory/contact.md", "theory/surfaces.md"}},
    {"Breakage", "breakage", {"theory/breakage.md"}},
    {"Membrane", "membrane", {"theory/membrane.md"}},
    {"Coupling", "coupling", {"theory/interface.md"}},
    {"Time", "time", {"theory/time_step.md"}},
    {"Walls", "walls", {"theory/walls.md"}},
    {"Specimen", "", {"theory/shape.md", "theory/preparation.md"}},
    {"Preparation", "", {"theory/preparation.md"}},
    {"Boundary",
     "",
     {"theory/membrane.md", "theory/walls.md", "theory/periodic_cell.md"}},
    {"CycleJump", "", {"theory/cycle_jump.md"}},
    {"Press", "", {"theory/breakage.md"}},
    {"Charge", "", {"theory/shape.md"}},
    {"Drum", "", {"theory/walls.md"}},
    {"Container", "container", {"theory/pouring.md", "theory/membrane.md"}},
    {"Filling", "", {"theory/preparation.md"}},
    {"Plate", "", {"theory/plate.md"}},
    {"Layer", "", {"theory/preparation.md"}},
    {"LoadPlate", "", {"theory/subgrade.md"}},
    {"Subgrade", "", {"theory/subgrade.md", "theory/solid.md"}},
    {"Pulse", "", {"theory/subgrade.md"}},
    {"GroundContact", "", {"theory/contact.md", "theory/interface.md"}},
    {"Box", "", {"theory/periodic_cell.md"}},
    {"Fill", "", {"theory/preparation.md"}}};
} // namespace

ManualPages manual_pages(const ListedSection &section)
{
  // Walls/NAME is a section Walls.
  const std::string name = section.name.substr(0, section.name.find('/'));
  const auto found = std::ranges::find(all_pages, name, &ManualPages::section);
  ManualPages result = found == all_pages.end() ? ManualPages{name} : *found;
  if (result.page.empty())
    result.page = section.kinds.empty() ? "case" : section.kinds.front();
  return result;
}
} // namespace spall
