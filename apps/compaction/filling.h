#pragma once

#include "test/preparation_text.h"

namespace spall
{
/// All that decides the filling; `longest_step` of a particle, for a filling
/// with the steps of Time [s].
std::string filling_text(const Case &parameters, const ShapeLibrary &shapes,
                         double longest_step);
} // namespace spall
