#pragma once

#include "report/text_table.h"
#include "study/level_costs.h"

namespace spall
{
/// Tables of the page of a study; without rows where there are no results.

/// What was expected, what others found, what the cases show.
TextTable expectation_table(const StudyData &data);
/// Every level against the first of its key, and which differences exceed
/// what the seeds differ by.
TextTable difference_table(const StudyData &data, std::size_t key);
/// The same in a line for each outcome; without rows for a single seed.
TextTable spread_table(const StudyData &data, std::size_t key);
/// Error and cost of every value against the reference.
TextTable cost_table(const StudyData &data);
/// Conclusions for the defaults of the program.
TextTable default_table(const StudyData &data);
TextTable failure_table(const StudyData &data);
TextTable case_table(const StudyData &data);
} // namespace spall
