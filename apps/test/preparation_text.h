#pragma once

#include "case/parameter.h"
#include "specimen/specimen.h"

#include <string>
#include <vector>

namespace spall
{
/// What decides the prepared particles, one line each: the version, then the
/// parameters with the flag decides_preparation; of keys that name files, their
/// contents. Left out is what the case has no
/// use for: by `unused`, which names keys as Section/key, and of the steps what
/// Time does not use, or all of it and the tolerances of Contact where the
/// preparation has its own (`own_safety` > 0). The same text, the same
/// particles bit for bit.
std::string preparation_text(const Case &parameters, const ShapeLibrary &shapes,
                             double own_safety,
                             const std::vector<std::string> &unused = {});
} // namespace spall
