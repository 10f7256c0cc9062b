#include "run/refusals.h"

#include <cstdio>
#include <utility>

namespace spall
{
std::string Refusals::news(const dem::Engine &engine)
{
  const int now = engine.n_refused_events(),
            fresh = now - std::exchange(known, now);
  if (fresh <= 0)
    return "";
  char text[120];
  std::snprintf(text, sizeof text,
                "at %.6g s: %d breakage event%s refused, the shape would not "
                "stay star-shaped (%d in all)",
                engine.time(), fresh, fresh > 1 ? "s" : "", now);
  return text;
}
} // namespace spall
