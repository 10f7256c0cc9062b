#pragma once

#include "study/prices.h"

namespace spall
{
/// Sections of the page of a study; empty where there is nothing to say.

/// What was expected, what others found, what the cases show.
std::string expectation_table(const StudyData &data);
/// Every level against the first of its key, and which differences exceed
/// what the seeds differ by.
std::string difference_table(const StudyData &data, std::size_t key);
/// Error and cost of every value against the reference.
std::string price_table(const StudyData &data);
std::string failure_table(const StudyData &data);
std::string case_table(const StudyData &data);
} // namespace spall
