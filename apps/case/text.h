#pragma once

#include <span>
#include <string>

namespace spall
{
/// The words with ", " between them.
std::string joined(std::span<const std::string> words);

/// A function object of several functions, for std::visit.
template <class... Functions>
struct Overloaded : Functions...
{
  using Functions::operator()...;
};
template <class... Functions>
Overloaded(Functions...) -> Overloaded<Functions...>;
} // namespace spall
