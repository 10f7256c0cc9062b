#pragma once

#include "case/checks.h"

namespace spall
{
/// Of a case of kind subgrade. Throws InputError.
void check_subgrade(const Case &parameters, const Place &place);
} // namespace spall
