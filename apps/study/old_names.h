#pragma once

#include "study/study.h"

namespace spall
{
/// Replaces deprecated keys and values of cases in what the study sets, sweeps
/// and expects; study.deprecated gets a line for each.
void replace_old_names(Study &study);
} // namespace spall
