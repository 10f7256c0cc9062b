#pragma once

#include "case/parameter.h"
#include "case/source.h"

#include <string>
#include <vector>

/// Sections, keys and values of earlier releases. The lists of sections and
/// parameters carry the old names; a case is read with the present ones.
namespace spall
{
/// Replaces old names of section, key and value by the present names of `list`.
/// Each replacement appends one line to `notes`:
/// "case.prm:12: deprecated key Stone/friction: use Particle/friction".
void use_present_names(Assignment &a, const std::vector<Parameter> &list,
                       std::vector<std::string> &notes);
} // namespace spall
