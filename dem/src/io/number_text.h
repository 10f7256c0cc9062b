#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace dem::detail
{
/// The number that this word is, nan and inf included, if it is one.
std::optional<double> any_number_in(std::string_view word);

/// The finite number that this word is, if it is one.
std::optional<double> number_in(std::string_view word);

/// What to do about a word that would be a number with a decimal point in
/// position of its comma; empty for any other word.
std::string comma_hint(std::string_view word);
} // namespace dem::detail
