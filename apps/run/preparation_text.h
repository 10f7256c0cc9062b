#pragma once

#include "case/parameter.h"
#include "specimen/specimen.h"

#include <functional>
#include <span>
#include <string>
#include <vector>

namespace spall
{
/// A key of a case by its name, or all of a section.
struct CaseKey
{
  const char *section, *key = nullptr; ///< null: every key

  bool names(const Parameter &parameter) const
  {
    return parameter.section == section && (!key || parameter.key == key);
  }
};

/// Keys that decide the particles of a test when they are prepared, and those
/// that come into play only afterwards or never touch what is computed. A
/// test's own are added to what all kinds have in common.
struct PreparationKeys
{
  PreparationKeys(std::span<const CaseKey> own_deciding,
                  std::span<const CaseKey> own_later);

  std::vector<CaseKey> deciding, later;
};

bool lists(std::span<const CaseKey> keys, const Parameter &parameter);

/// What decides the prepared particles, one line each: the version, then the
/// deciding keys; of the keys `gradation` and `shapes`, which name files, their
/// contents. Left out is what the case has no use for: by `is_unused`, and of
/// the steps what Time does not ask for, or all of it and the tolerances of
/// Contact where the preparation has its own (`own_safety` > 0). The same text,
/// the same particles bit for bit.
std::string
preparation_text(const Case &parameters, const PreparationKeys &keys,
                 const ShapeLibrary &shapes, double own_safety,
                 const std::function<bool(const Parameter &)> &is_unused);
} // namespace spall
