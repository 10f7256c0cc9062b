#pragma once

#include <dem/parallel/ranks.h>

#include <string>

namespace dem
{
/// The message of the first rank that has one; empty where none has. The same
/// on all ranks. Collective.
std::string first_fault(const Ranks &ranks, const std::string &own);

/// Throws first_fault() on all ranks if there is one. Collective.
template <class Error>
void stop_together(const Ranks &ranks, const std::string &own)
{
  if (const std::string fault = first_fault(ranks, own); !fault.empty())
    throw Error(fault);
}
} // namespace dem
