#include "case/list.h"
#include "los_angeles/kind.h"

namespace spall
{
namespace
{
void add_charge(List &list, ChargeParameters &c)
{
  list.in("Charge");
  list.add({"mass", "kg", "Total mass of the particles."}, c.mass,
           above(0., 1e4));
  add_drawn_particles(list, c);
  list.add({"balls", "-", "Number of steel balls."}, c.balls, between(0, 1000));
  list.add({"ball_mass", "kg", "Mass of all steel balls together."},
           c.ball_mass, above(0., 1e4));
  list.add({"ball_density", "kg/m^3", "Density of the steel balls."},
           c.steel.density, above(0., 3e4));
  list.add({"ball_shear_modulus", "Pa",
            "Shear modulus of the steel balls. Their friction and damping are "
            "those of Particle."},
           c.steel.shear_modulus, between(1., 1e13));
  list.add({"ball_poisson_ratio", "-", "Poisson's ratio of the steel balls."},
           c.steel.poisson_ratio, below(0., 0.5));
}

void add_drum(List &list, DrumParameters &d)
{
  list.in("Drum");
  list.add({"radius", "m", "Inner radius."}, d.radius, above(0., 100.));
  list.add({"length", "m", "Inner length."}, d.length, above(0., 100.));
  list.add({"lifter_height",
            "m",
            "Radial height of the lifter inside the drum; 0: no lifter.",
            "",
            {"shelf_height"}},
           d.lifter_height, between(0., 100.));
  list.add({"lifter_thickness",
            "m",
            "Thickness of the lifter.",
            "",
            {"shelf_thickness"}},
           d.lifter_thickness, above(0., 100.));
  list.add(
      {"turns_per_minute", "1/min", "Rotation rate; 31 to 33 in the test."},
      d.turns_per_minute, above(0., 1e4));
  list.add({"turns", "-", "Total number of revolutions."}, d.turns,
           above(0., 1e7))
      .may_change = true;
  list.add({"settling_time", "s",
            "Shortest fall under gravity before the first turn. It ends when "
            "the charge is at rest. 0: the drum turns at once."},
           d.settling_time, between(0., 100.));
  list.add({"settling_max_time", "s",
            "The drum turns this long after settling_time in any case, with a "
            "warning."},
           d.settling_max_time, between(0., 1e3));
  list.add({"settling_unbalanced_ratio", "-",
            "At rest: sum of the resultant forces over the weight; 1: the "
            "charge is not asked for rest."},
           d.settling_unbalanced_ratio, above(0., 1.));
  list.in("Drum", {.may_change = true});
  list.add({"rows_per_turn", "-", "Rows of history.csv."}, d.rows_per_turn,
           between(1, 1e6));
  list.add({"frames_per_turn", "-", "Frames for ParaView; 0: first and last."},
           d.frames_per_turn, between(0, 1e4));
  list.add({"checkpoint_every", "-",
            "Revolutions between checkpoints; 0: only at the end."},
           d.checkpoint_every, between(0, 1e7));
}
} // namespace

void add_los_angeles(List &list, Case &of)
{
  add_charge(list, of.charge);
  add_drum(list, of.drum);
}
} // namespace spall
