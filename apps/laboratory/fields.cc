#include "case/list.h"

#include <dem/shape/spherical_harmonics.h>

namespace spall
{
namespace
{
void add_particle(List &list, ParticleParameters &p)
{
  list.in("Particle");
  list.add({"shape", "-", "Shape file; empty: a sphere, which never breaks."},
           p.shape);
  list.add({"diameter", "m", "Twice the ball radius, d."}, p.diameter,
           above(0., 10.));
  list.add({"order", "-", "N_s: what the file has beyond is cut off."}, p.order,
           between(1, dem::max_order));
  list.add({"axis_x", "-", "Body direction that points up (seed 0)."}, p.axis_x,
           between(-1e6, 1e6));
  list.add({"axis_y", "-", "Likewise."}, p.axis_y, between(-1e6, 1e6));
  list.add({"axis_z", "-", "Likewise."}, p.axis_z, between(-1e6, 1e6));
  list.add({"seed", "-", "Of a random orientation; 0: by the axis."}, p.seed,
           between(0, 2147483647));
}

void add_press(List &list, PressParameters &p)
{
  list.in("Press");
  list.add({"displacement", "m", "Of the upper platen, in all."},
           p.displacement, above(0., 1.));
  list.add({"speed", "m/s",
            "Of the upper platen. The test has 8.3e-6 (0.5 mm/min); any speed "
            "whose double changes nothing will do."},
           p.speed, above(0., 10.));
  list.add({"rows", "-", "Of history.csv; one more at each event."}, p.rows,
           between(10, 1e7));
}

void add_charge(List &list, ChargeParameters &c)
{
  list.in("Charge");
  list.add({"mass", "kg", "Of the stones."}, c.mass, above(0., 1e4));
  list.add({"gradation", "-",
            "CSV file diameter_m,passing_1: share of the mass that passes."},
           c.gradation);
  list.add({"shapes", "-", "Folder of shape files; empty: spheres."}, c.shapes);
  list.add({"order", "-", "N_s: what the files have beyond is cut off."},
           c.order, between(1, dem::max_order));
  list.add({"seed", "-", "Of sizes, shapes, places and orientations."}, c.seed,
           between(0, 2147483647));
  list.add({"balls", "-", "Number of steel balls."}, c.balls, between(0, 1000));
  list.add({"ball_mass", "kg", "Of all balls together."}, c.ball_mass,
           above(0., 1e4));
  list.add({"ball_density", "kg/m^3", "Steel."}, c.steel.density,
           above(0., 3e4));
  list.add({"ball_shear_modulus", "Pa",
            "Steel. Friction and damping of the balls are those of Stone."},
           c.steel.shear_modulus, between(1., 1e13));
  list.add({"ball_poisson_ratio", "-", "Steel."}, c.steel.poisson_ratio,
           below(0., 0.5));
}

void add_drum(List &list, DrumParameters &d)
{
  list.in("Drum");
  list.add({"radius", "m", "Inner."}, d.radius, above(0., 100.));
  list.add({"length", "m", "Inner."}, d.length, above(0., 100.));
  list.add({"shelf_height", "m", "Of the shelf, into the drum; 0: no shelf."},
           d.shelf_height, between(0., 100.));
  list.add({"shelf_thickness", "m", "Of the shelf."}, d.shelf_thickness,
           above(0., 100.));
  list.add({"turns_per_minute", "1/min", "31 to 33 in the test."},
           d.turns_per_minute, above(0., 1e4));
  list.add({"turns", "-", "In all."}, d.turns, above(0., 1e7));
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
  list.add({"rows_per_turn", "-", "Rows of history.csv."}, d.rows_per_turn,
           between(1, 1e6));
  list.add({"frames_per_turn", "-", "Frames for ParaView; 0: first and last."},
           d.frames_per_turn, between(0, 1e4));
  list.add({"checkpoint_every", "-", "Turns; 0: only at the end."},
           d.checkpoint_every, between(0, 1e7));
}
} // namespace

void add_laboratory(List &list, Case &of)
{
  add_particle(list, of.particle);
  add_press(list, of.press);
  add_charge(list, of.charge);
  add_drum(list, of.drum);
}
} // namespace spall
