#include "run/refusals.h"

#include <cstdio>

namespace spall
{
std::string Refusals::news(const dem::Engine &engine)
{
  const int now = engine.n_refused_events();
  if (now == said || now < 2 * said)
    return "";
  said = now;
  char text[120];
  std::snprintf(text, sizeof text,
                "by %.6g s %d breakage event%s refused, as the shape would not "
                "have stayed star-shaped",
                engine.time(), now, now > 1 ? "s were" : " was");
  return text;
}
} // namespace spall
