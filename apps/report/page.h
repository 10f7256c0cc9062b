#pragma once

#include "report/chart.h"
#include "report/render.h"
#include "report/run_data.h"

#include <span>
#include <string>
#include <vector>

namespace spall
{
/// Everything of a page; pictures[k] and so on belong to runs[k].
struct Report
{
  std::span<const RunData> runs;
  std::vector<Chart> charts;
  std::vector<Picture> pictures; ///< of the particles
  std::vector<Picture> networks; ///< of contact forces and bulge
  std::vector<Picture> grounds;  ///< of the settled subgrade
};

/// One HTML page that needs no other file and no network.
std::string make_page(const Report &report);
} // namespace spall
