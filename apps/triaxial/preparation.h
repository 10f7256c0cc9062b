#pragma once

#include "specimen/specimen.h"

#include <span>
#include <string>

namespace spall
{
/// A key of a case by its name.
struct CaseKey
{
  const char *section, *key;
};

/// Keys that decide the prepared specimen; of the two that name files their
/// contents. Which of them a case does not use, it leaves out.
std::span<const CaseKey> keys_of_preparation();

/// Keys of a triaxial test that come into play only afterwards, or never touch
/// what is computed. Every key of the test is in one of the two lists.
std::span<const CaseKey> keys_after_preparation();

/// All that decides the prepared specimen of a triaxial test, one line each:
/// the same text, the same specimen bit for bit.
std::string preparation_text(const Case &parameters,
                             const ShapeLibrary &shapes);
} // namespace spall
