#pragma once

#include "run/preparation_text.h"

namespace spall
{
/// Every key of a compaction is in one of the two lists.
const PreparationKeys &filling_keys();

/// All that decides the filling; `longest_step` of a particle, for a filling
/// with the steps of Time [s].
std::string filling_text(const Case &parameters, const ShapeLibrary &shapes,
                         double longest_step);
} // namespace spall
