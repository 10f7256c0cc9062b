#pragma once

#include "report/chart.h"

#include <string>

namespace spall
{
/// A link that saves a table held by the page itself.
std::string csv_link(const std::string &file, const std::string &csv);

/// Figure, caption, notes and the link to its numbers.
std::string html_figure(const Chart &chart);

/// Lines that say what is missing.
std::string html_notes(const std::vector<std::string> &lines);
} // namespace spall
