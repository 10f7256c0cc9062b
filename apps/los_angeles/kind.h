#pragma once

#include "case/kind.h"

namespace spall
{
/// The Los Angeles abrasion test.
TestKind los_angeles_kind();

/// The keys of its sections.
void add_los_angeles(List &list, Case &of);
/// Checks beyond single ranges. Throws InputError.
void check_los_angeles(const Case &parameters, const SourceLocation &location);
/// Its headlines, rows of the table and charts.
const KindReport &los_angeles_report();
} // namespace spall
