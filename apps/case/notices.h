#pragma once

#include "case/case.h"
#include "case/kind.h"
#include "case/parameter.h"

#include <string>
#include <vector>

namespace spall
{
/// A line for each value that is allowed and likely a slip: in another unit, or
/// without effect. `list` is that of a case that has been checked, `set` says
/// where its values are set.
std::vector<std::string> notices_on(const Case &parameters,
                                    const std::vector<Parameter> &list,
                                    const SetLocations &set);

/// "unusual: most are 500 to 1e+09 Pa, so check the unit"
std::string unusual_text(const Range &usual, const std::string &unit);
} // namespace spall
