#pragma once

#include "case/file.h"
#include "case/source.h"

#include <string>
#include <vector>

/// The text of a study file in pieces.
namespace spall
{
/// Throws InputError: location, section, key, value and what is allowed.
[[noreturn]] void refuse(const Assignment &a, const std::string &allowed);

/// What stands between separators, without the blanks around it; nothing empty.
std::vector<std::string> words_of(const std::string &text, char separator);

/// As a value reads back from a case: 5e8 is 5e+08; other text as it is.
std::string same_text(const std::string &value);

/// Section/key of a setting; "preset" of one.
std::string key_name(const Override &setting);
} // namespace spall
