#pragma once

#include <array>
#include <cstddef>

namespace spall
{
/// Sections of the report of a run, in the order of the page. Every figure,
/// picture and row of a table names the one it belongs to.
enum class ReportSection
{
  specimen,
  response,
  breakage,
  network,
  boundaries,
  energy,
  performance,
  input
};

struct SectionHeading
{
  const char *id, *title;
};

/// One for each section, in their order.
inline constexpr std::array section_headings = {
    SectionHeading{"specimen", "Specimen"},
    SectionHeading{"response", "Mechanical response"},
    SectionHeading{"breakage", "Particle breakage"},
    SectionHeading{"network", "Contact network"},
    SectionHeading{"boundaries", "Boundaries"},
    SectionHeading{"energy", "Energy balance"},
    SectionHeading{"performance", "Performance"},
    SectionHeading{"input", "Input"}};

static_assert(section_headings.size() ==
              static_cast<std::size_t>(ReportSection::input) + 1);
} // namespace spall
