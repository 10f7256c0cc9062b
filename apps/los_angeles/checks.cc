#include "case/checks.h"

#include "case/parameter.h"
#include "los_angeles/kind.h"

#include <algorithm>

namespace spall
{
void check_los_angeles(const Case &c, const SourceLocation &location)
{
  check_inertia(c, location);
  check_shapes(c, location, "Charge", c.charge.shapes);
  if (c.wall.rolling_friction > 0.)
    refuse(location,
           {"Wall", "rolling_friction", number_text(c.wall.rolling_friction),
            "must be 0: rolling resistance assumes walls that do not turn"});
  const DrumParameters &d = c.drum;
  if (d.lifter_height > 0.29 * d.radius)
    refuse(
        location,
        {"Drum", "lifter_height", number_text(d.lifter_height),
         "must be at most 0.29 Drum/radius = " + number_text(0.29 * d.radius) +
             " (the charge is put between the lifter and the axis)"});
  check_no_step_error(c, location);
  if (!c.charge.particles.empty())
    return; // their sizes are those of the file
  const Gradation curve =
      check_gradation(c, location, "Charge", c.charge.gradation);
  if (std::min(2. * d.radius, d.length) < 4. * curve.diameter.back())
    refuse(location, {"Drum", "radius", number_text(d.radius),
                      "the drum must be four times as wide and long as the "
                      "largest particle of the gradation, " +
                          largest_text(curve)});
}
} // namespace spall
