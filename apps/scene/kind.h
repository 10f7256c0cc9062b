#pragma once

#include "case/kind.h"

namespace spall
{
/// Particles, walls and gravity, of the case.
TestKind scene_kind();

/// The keys of its sections.
void add_scene(List &list, Case &of);
/// Checks beyond single ranges. Throws InputError.
void check_scene(const Case &parameters, const SourceLocation &location);
/// Its headlines, rows of the table and charts.
const KindReport &scene_report();
} // namespace spall
