#pragma once

#include "run/preparation_text.h"

namespace spall
{
/// Every key of a triaxial test is in one of the two lists.
const PreparationKeys &preparation_keys();

/// All that decides the prepared specimen of a triaxial test.
std::string preparation_text(const Case &parameters,
                             const ShapeLibrary &shapes);
} // namespace spall
