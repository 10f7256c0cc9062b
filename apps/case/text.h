#pragma once

#include <span>
#include <string>

namespace spall
{
/// The words with ", " between them.
std::string joined(std::span<const std::string> words);
} // namespace spall
