#pragma once

#include "case/case.h"

#include <string>

namespace spall
{
/// Every parameter of a case of its kind with its default, its value, unit and
/// what is allowed, as JSON.
std::string parameter_json(Case of);

/// The same of the case that template_case prints; the section Walls/NAME
/// stands for any wall.
std::string template_json(const std::string &kind);
} // namespace spall
