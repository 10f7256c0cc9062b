#pragma once

#include "case/kind.h"

namespace spall
{
/// Plate or sleeper on particles on a subgrade.
TestKind subgrade_kind();

/// The keys of its sections.
void add_subgrade(List &list, Case &of);
/// Checks beyond single ranges. Throws InputError.
void check_subgrade(const Case &parameters, const SourceLocation &location);
/// On the values of the layers of the ground.
std::vector<std::string> subgrade_notices(const Case &parameters,
                                          const SetLocations &set);
/// Its headlines, rows of the table and charts.
const KindReport &subgrade_report();
} // namespace spall
