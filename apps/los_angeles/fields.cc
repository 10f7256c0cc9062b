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
  add_placed_particles(list, c,
                       "particles are drawn from the gradation. Placed ones "
                       "are the whole charge, the steel balls as material "
                       "other, and fall from where they are.");
  add_drawn_particles(list, c);
  list.add({"balls", "-", "Number of steel balls."}, c.balls, between(0, 1000));
  list.add({"ball_mass", "kg", "Mass of all steel balls together."},
           c.ball_mass, above(0., 1e4), between(1e-3, 200.));
  list.add({"ball_density", "kg/m^3", "Mass density of the steel balls."},
           c.steel.density, above(0., 3e4), usual_densities);
  list.add({"ball_shear_modulus", "Pa",
            "Shear modulus of the steel balls. Their friction and damping are "
            "those of section Particle."},
           c.steel.shear_modulus, between(1., 1e13), usual_moduli);
  list.add({"ball_poisson_ratio", "-", "Poisson's ratio of the steel balls."},
           c.steel.poisson_ratio, below(0., 0.5));
}

void add_drum(List &list, DrumParameters &d)
{
  list.in("Drum");
  list.add({"radius", "m", "Inner radius of the drum."}, d.radius,
           above(0., 100.), usual_lengths);
  list.add({"length", "m", "Inner length of the drum."}, d.length,
           above(0., 100.), usual_lengths);
  list.add({"lifter_height",
            "m",
            "Radial height of the lifter inside the drum. The value 0 removes "
            "the lifter.",
            "",
            {"shelf_height"}},
           d.lifter_height, between(0., 100.));
  list.add({"lifter_thickness",
            "m",
            "Thickness of the lifter.",
            "",
            {"shelf_thickness"}},
           d.lifter_thickness, above(0., 100.));
  list.add({"turns_per_minute", "1/min",
            "Rotation rate of the drum. The standard test requires 31 to 33."},
           d.turns_per_minute, above(0., 1e4));
  list.add({"turns", "-", "Total number of revolutions of the drum."}, d.turns,
           above(0., 1e7))
      .may_change = true;
  list.add({"settling_time", "s",
            "Shortest settling under gravity before the first revolution. It "
            "ends when the charge is at rest. With the value 0 the drum "
            "rotates at once."},
           d.settling_time, between(0., 100.));
  list.add({"settling_max_time", "s",
            "Largest time to rest after settling_time. The drum then rotates "
            "in any case, with a warning."},
           d.settling_max_time, between(0., 1e3));
  list.add({"settling_unbalanced_ratio", "-",
            "Limit for a charge at rest: sum of the resultant forces over the "
            "weight. The value 1 does not require rest."},
           d.settling_unbalanced_ratio, above(0., 1.));
  list.in("Drum", {.may_change = true});
  list.add(
      {"rows_per_turn", "-", "Number of rows of history.csv per revolution."},
      d.rows_per_turn, between(1, 1e6));
  list.add({"frames_per_turn", "-",
            "Number of ParaView frames per revolution. The value 0 writes the "
            "first and the last."},
           d.frames_per_turn, between(0, 1e4));
  list.add({"checkpoint_every", "-",
            "Number of revolutions between checkpoints. The value 0 writes one "
            "at the end only."},
           d.checkpoint_every, between(0, 1e7));
}
} // namespace

void add_los_angeles(List &list, Case &of)
{
  add_charge(list, of.charge);
  add_drum(list, of.drum);
}
} // namespace spall
