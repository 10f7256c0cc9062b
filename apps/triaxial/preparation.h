#pragma once

#include "test/preparation_text.h"

namespace spall
{
/// All that decides the prepared specimen of a triaxial test.
std::string specimen_text(const Case &parameters, const ShapeLibrary &shapes);
} // namespace spall
