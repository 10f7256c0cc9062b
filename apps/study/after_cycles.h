#pragma once

#include "study/study.h"

namespace spall
{
/// The outcomes of a run after this number of load cycles, from its cycles.csv
/// and, for changes, from the start in its summary.json: in the order of
/// `outcomes`, keys of summary.json. Between two rows, where cycles were jumped
/// over, a value is linear in the cycle. NaN where the run did not come so far,
/// and for outcomes that no column of cycles.csv gives.
std::vector<double> outcomes_after(int cycle,
                                   const std::vector<std::string> &outcomes,
                                   const std::filesystem::path &run);

/// The results of a study with the outcomes after cycle number
/// `study.after_cycles[k]` in place of those of the end.
std::vector<PointResult> results_after(const StudyData &data, std::size_t k);
} // namespace spall
