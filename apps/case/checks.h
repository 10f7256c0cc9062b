#pragma once

#include "case/case.h"
#include "specimen/gradation.h"

#include <functional>
#include <string>

namespace spall
{
/// Where a value was said: "case.prm:12" by section and key, for messages.
using Place =
    std::function<std::string(const std::string &, const std::string &)>;

/// One refusal: section, key and value as given, and what is allowed.
struct Fault
{
  std::string section, key, value, allowed;
};

/// Throws InputError with the place.
[[noreturn]] void refuse(const Place &place, const Fault &fault);

/// The table that the key `gradation` of a section names.
Gradation check_gradation(const Case &c, const Place &place,
                          const std::string &section, const std::string &file);
/// A folder of shapes, or none.
void check_shapes(const Case &c, const Place &place, const std::string &section,
                  const std::string &shapes);
/// With Coupling/exchange = every_step nothing has steps of its own.
void check_every_step(const Case &c, const Place &place);

/// What no single range can say: parameters against each other and against
/// the files they name. Throws InputError.
void check_case(const Case &parameters, const Place &place);

/// Of a vibratory_compaction case alone, all but its time and coupling.
void check_compaction(const Case &c, const Place &place);
} // namespace spall
