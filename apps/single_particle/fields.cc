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
  list.add_path({"shape", "-",
                 "Shape file of the particle. Empty stands for a sphere, which "
                 "never breaks."},
                p.shape);
  list.add({"diameter", "m",
            "Diameter d of the particle: twice its equivalent radius."},
           p.diameter, above(0., 10.));
  list.add({"order", "-",
            "Order N_s of the spherical-harmonic series. Higher terms of the "
            "file are omitted."},
           p.order, between(1, dem::max_order));
  list.add(
      {"axis_x", "-",
       "Component x of the body direction that points upward, for seed = 0."},
      p.axis_x, between(-1e6, 1e6));
  list.add(
      {"axis_y", "-",
       "Component y of the body direction that points upward, for seed = 0."},
      p.axis_y, between(-1e6, 1e6));
  list.add(
      {"axis_z", "-",
       "Component z of the body direction that points upward, for seed = 0."},
      p.axis_z, between(-1e6, 1e6));
  list.add({"seed", "-",
            "Seed of a random orientation. The value 0 uses the orientation of "
            "axis_x, axis_y and axis_z."},
           p.seed, between(0, 2147483647));
}

void add_press(List &list, PressParameters &p)
{
  list.in("Press");
  list.add({"displacement", "m", "Total displacement of the upper platen."},
           p.displacement, above(0., 1.));
  list.add({"speed", "m/s",
            "Speed of the upper platen. The laboratory test has 8.3e-6 (0.5 "
            "mm/min). A higher speed is acceptable if doubling it does not "
            "change the result."},
           p.speed, above(0., 10.));
  list.add({"rows", "-",
            "Number of rows of history.csv in the whole displacement. Each "
            "breakage event adds one row."},
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
