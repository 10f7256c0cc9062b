#pragma once

#include <string>

namespace spall
{
/// Watches for breakage events that are refused, because a particle would have
/// lost r > 0: those particles keep their shape.
class Refusals
{
public:
  /// `n_before` are known already.
  explicit Refusals(int n_before) : said(n_before) {}

  /// Message on `now` events by `time` [s], the first time and
  /// whenever their number has doubled since; else empty.
  std::string news(int now, double time);

private:
  int said;
};
} // namespace spall
