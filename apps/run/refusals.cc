#include "run/refusals.h"

#include <cstdio>

namespace spall
{
std::string Refusals::news(int now, double time)
{
  if (now == said || now < 2 * said)
    return "";
  said = now;
  char text[120];
  std::snprintf(text, sizeof text,
                "by %.6g s %d breakage event%s refused, as the shape would not "
                "have stayed star-shaped",
                time, now, now > 1 ? "s were" : " was");
  return text;
}
} // namespace spall
