#pragma once

#include "report/run_data.h"

#include <string>

namespace spall
{
/// Slices through the specimen of a run where its loading begins and where the
/// run ends.
struct SliceFigure
{
  std::string id;      ///< file name without ending
  std::string svg;     ///< empty: the run has no slices
  std::string csv;     ///< corners of what is drawn [m]
  std::string caption; ///< full sentences
};

/// From slices_start.csv, slices_end.csv and summary.json of the folder.
SliceFigure slice_figure(const RunData &run, const std::string &id);

/// Figure, caption and the link to its numbers; empty without slices.
std::string html_figure(const SliceFigure &figure);
} // namespace spall
