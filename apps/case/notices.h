#pragma once

#include "case/case.h"
#include "case/parameter.h"

#include <map>
#include <string>
#include <vector>

namespace spall
{
/// A line for each value that is allowed and likely a slip: in another unit, or
/// without effect. `list` is that of the case, `locations` says where the
/// parameters that are set, Section/key, are set.
std::vector<std::string>
notices_on(const Case &parameters, const std::vector<Parameter> &list,
           const std::map<std::string, std::string> &locations);
} // namespace spall
