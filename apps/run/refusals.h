#pragma once

#include <dem/engine.h>

#include <string>

namespace spall
{
/// Watches for breakage events that are refused, because a stone would have
/// lost r > 0: those stones keep their shape.
class Refusals
{
public:
  explicit Refusals(const dem::Engine &engine) : said(engine.n_refused_events())
  {
  }

  /// What there is to say, the first time and whenever their number has
  /// doubled since; else empty.
  std::string news(const dem::Engine &engine);

private:
  int said;
};
} // namespace spall
