#pragma once

#include "case/kind.h"

namespace spall
{
/// The compression of one particle between platens.
TestKind single_particle_kind();

/// The keys of its sections.
void add_single_particle(List &list, Case &of);
/// Checks beyond single ranges. Throws InputError.
void check_single_particle(const Case &parameters,
                           const SourceLocation &location);
/// Its headlines, rows of the table and charts.
const KindReport &single_particle_report();
} // namespace spall
