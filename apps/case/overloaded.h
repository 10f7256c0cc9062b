#pragma once

namespace spall
{
/// A function object of several functions, for std::visit.
template <class... Functions>
struct Overloaded : Functions...
{
  using Functions::operator()...;
};
template <class... Functions>
Overloaded(Functions...) -> Overloaded<Functions...>;
} // namespace spall
