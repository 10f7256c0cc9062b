#pragma once

#include "case.h"

#include <functional>
#include <string>

namespace spall
{
/// Where a value was said: "case.prm:12" by section and key, for messages.
using Place =
    std::function<std::string(const std::string &, const std::string &)>;

/// What no single range can say: parameters against each other and against
/// the files they name. Throws InputError.
void check_case(const Case &parameters, const Place &place);
} // namespace spall
