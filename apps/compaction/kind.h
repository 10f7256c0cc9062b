#pragma once

#include "case/kind.h"

namespace spall
{
/// The vibratory compaction test.
TestKind compaction_kind();

/// The keys of its sections.
void add_compaction(List &list, Case &of);
/// Checks beyond single ranges. Throws InputError.
void check_compaction(const Case &parameters, const SourceLocation &location);
/// On reports after the end.
std::vector<std::string> compaction_notices(const Case &parameters,
                                            const SetLocations &set);
/// Its headlines, rows of the table and charts.
const KindReport &compaction_report();
} // namespace spall
