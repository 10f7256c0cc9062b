#include "case/checks.h"

#include "case/file.h"
#include "case/parameter.h"
#include "single_particle/kind.h"

namespace spall
{
void check_single_particle(const Case &c, const SourceLocation &location)
{
  const SingleParticleParameters &p = c.single_particle;
  if (!p.shape.empty())
    find_path(c, "Particle", "shape", p.shape);
  if (p.seed == 0 && p.axis_x == 0. && p.axis_y == 0. && p.axis_z == 0.)
    refuse(location, {"Particle", "axis_z", "0",
                      "must not be zero along with axis_x and axis_y"});
  if (c.press.displacement >= p.diameter)
    refuse(location,
           {"Press", "displacement", number_text(c.press.displacement),
            "must be below Particle/diameter = " + number_text(p.diameter)});
  for (const WallSection &wall : c.walls)
    if (wall.name == "lower" || wall.name == "upper")
      check_at_rest(c, location, wall,
                    "must not be set for a platen, which the press moves");
  check_no_step_error(c, location);
}
} // namespace spall
