#pragma once

#include "case/kind.h"

namespace spall
{
/// The dynamic triaxial test.
TestKind triaxial_kind();

/// The keys of its sections.
void add_triaxial(List &list, Case &of);
/// Checks beyond single ranges. Throws InputError.
void check_triaxial(const Case &parameters, const SourceLocation &location);
/// On the stresses of a loading path.
std::vector<std::string> triaxial_notices(const Case &parameters,
                                          const SetLocations &set);
/// Its headlines, rows of the table and charts.
const KindReport &triaxial_report();
} // namespace spall
