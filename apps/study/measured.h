#pragma once

#include "study/levels.h"

namespace spall
{
/// Points that others have measured, along the curve of a study.
struct MeasuredPoints
{
  std::vector<double> x, y;
};

/// Of Study::measured, those at this value of a key with all other keys that
/// are columns of the file as in the base case, or the first of the sweep; none
/// without a file or a column of that key.
MeasuredPoints measured_points(const StudyData &data, const Cut &cut,
                               const std::string &value);

/// Throws InputError unless the file has the columns of the curve, and one of a
/// swept key.
void check_measured(const Study &study);
} // namespace spall
