#pragma once

#include <dem/parallel/ranks.h>

#include <functional>
#include <string>

namespace spall
{
/// Calls `call` on the first rank alone: files are read and written by one
/// process. What it throws there all ranks throw, as InputError or RunFailure.
/// Collective.
void on_first_rank(const dem::Ranks &ranks, const std::function<void()> &call);

/// Calls `call` on every rank. What the first of them throws all throw, as
/// InputError or RunFailure. Collective.
void on_every_rank(const dem::Ranks &ranks, const std::function<void()> &call);

/// Whether it is so on some rank. Collective.
bool on_any_rank(const dem::Ranks &ranks, bool is_so);
} // namespace spall
