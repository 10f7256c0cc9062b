#include "case/list.h"
#include "single_particle/kind.h"

#include <dem/shape/spherical_harmonics.h>

namespace spall
{
namespace
{
void add_particle(List &list, SingleParticleParameters &p)
{
  list.in("Particle");
  list.add_path(
      {"shape", "-", "Shape file; empty: a sphere, which never breaks."},
      p.shape);
  list.add({"diameter", "m", "Twice the equivalent radius, d."}, p.diameter,
           above(0., 10.));
  list.add({"order", "-", "N_s: what the file has beyond is cut off."}, p.order,
           between(1, dem::max_order));
  list.add({"axis_x", "-",
            "Component x of the body direction that points up (seed 0)."},
           p.axis_x, between(-1e6, 1e6));
  list.add({"axis_y", "-", "Component y of the body direction that points up."},
           p.axis_y, between(-1e6, 1e6));
  list.add({"axis_z", "-", "Component z of the body direction that points up."},
           p.axis_z, between(-1e6, 1e6));
  list.add({"seed", "-",
            "Seed of a random orientation; 0: the orientation of axis_x, "
            "axis_y, axis_z."},
           p.seed, between(0, 2147483647));
}

void add_press(List &list, PressParameters &p)
{
  list.in("Press");
  list.add({"displacement", "m", "Total displacement of the upper platen."},
           p.displacement, above(0., 1.));
  list.add(
      {"speed", "m/s",
       "Speed of the upper platen. The test has 8.3e-6 (0.5 mm/min); any speed "
       "whose double changes nothing will do."},
      p.speed, above(0., 10.));
  list.add({"rows", "-", "Rows of history.csv; one more at each event."},
           p.rows, between(10, 1e7))
      .may_change = true;
}
} // namespace

void add_single_particle(List &list, Case &of)
{
  add_particle(list, of.single_particle);
  add_press(list, of.press);
}
} // namespace spall
