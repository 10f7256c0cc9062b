#pragma once

#include "report/chart.h"
#include "report/pictures.h"
#include "report/run_data.h"
#include "report/slice_figure.h"

#include <span>
#include <string>
#include <vector>

namespace spall
{
/// Everything of a page; pictures[k] belong to runs[k].
struct Report
{
  std::span<const RunData> runs;
  std::vector<Chart> charts;
  std::vector<RunPictures> pictures;
  /// Of specimens, for runs that have them.
  std::vector<SliceFigure> slices = {};
};

/// One HTML page that needs no other file and no network.
std::string make_page(const Report &report);
} // namespace spall
