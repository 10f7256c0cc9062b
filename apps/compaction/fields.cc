#include "case/list.h"
#include "compaction/kind.h"

namespace spall
{
namespace
{
void add_container(List &list, ContainerParameters &c)
{
  list.in("Container", after_preparation);
  list.add({"form", "-",
            "rigid: a cylinder that does not move, as Wall; flexible: a tube "
            "of membrane held at both rims, which takes the place of the mould "
            "that the particles were poured into."},
           c.form, {"rigid", "flexible"});
  list.add({"diameter", "m", "Inner diameter."}, c.diameter, above(0., 100.))
      .decides_preparation = true;
  list.add({"height", "m", "Height that the particles fill."}, c.height,
           above(0., 100.))
      .decides_preparation = true;
  list.add({"elements_around", "-",
            "Flexible: quads round the tube, about as long as wide."},
           c.elements_around, between(8, 400));
  list.add({"freeboard", "m",
            "Flexible: length of the tube above Container/height."},
           c.freeboard, between(0., 100.));
  list.add({"pressure", "Pa",
            "Flexible: on the tube from outside; comes while the plate is "
            "seated."},
           c.pressure, between(0., 1e8));
}

void add_filling(List &list, FillingParameters &f)
{
  list.in("Filling");
  add_drawn_particles(list, f);
  list.add({"density", "kg/m^3",
            "Requested density: mass of the particles over the volume that "
            "they fill."},
           f.density, above(0., 3e4));
  list.add({"layers", "-", "Poured and tamped one by one."}, f.layers,
           between(1, 100));
  list.add({"undercompaction", "-",
            "Layers are tamped to less than the density, since the next ones "
            "press on them: the first by this share, the last by none."},
           f.undercompaction, below(0., 0.5));
  list.add({"solid_fraction", "-",
            "Solid fraction of the cloud of one layer before it falls.",
            "random insertion jams above"},
           f.solid_fraction, above(0., 0.35));
  list.add({"friction", "-",
            "Particle on particle while filling, to begin with: high is loose, "
            "and the "
            "tamper makes dense what is looser than asked."},
           f.friction, between(0., 10.));
  list.add({"friction_decay", "-",
            "Share of it left by each stroke that meets tamper_pressure above "
            "the density, when all particles are in; 1: the friction stays."},
           f.friction_decay, above(0., 1.));
  list.add({"local_damping", "-", "D_a: F - D_a |F| sgn(v) while filling."},
           f.local_damping, below(0., 1.));
  list.add({"tamper_speed", "m/s", "Speed of the tamper, down and up."},
           f.tamper_speed, above(0., 10.));
  list.add({"tamper_pressure", "Pa",
            "Pressure at which the tamper reverses, whatever the density."},
           f.tamper_pressure, above(0., 1e9));
  list.add({"max_strokes", "-", "Most strokes of the tamper on one layer."},
           f.max_strokes, between(1, 1000));
  list.add({"unbalanced_ratio", "-",
            "At rest: sum of the resultant forces over the weight."},
           f.unbalanced_ratio, above(0., 0.1));
  list.add({"max_time", "s", "The filling fails if a layer takes longer."},
           f.max_time, above(0., 1e4));
  list.add({"safety", "-",
            "Above 0: share of the stable step while filling, with the usual "
            "Contact/refresh_tolerance and skin, so that cases with "
            "others and other steps in Time share a filling; 0: as Contact and "
            "Time say."},
           f.safety, between(0., 1.));
}

void add_plate(List &list, PlateParameters &p)
{
  list.in("Plate", after_preparation);
  list.add({"form", "-",
            "rigid: moves along z only; tilting: rigid, moves along z and "
            "turns; elastic: bends about its axis, which is guided along z, "
            "with Coupling for what the particles and it "
            "tell each other."},
           p.form, {"rigid", "tilting", "elastic"});
  list.add({"mass", "kg",
            "All that moves with the plate: static load and exciter with its "
            "eccentric mass."},
           p.mass, above(0., 1e7));
  list.add(
      {"height", "m",
       "Tilting: height of the solid cylinder, as wide as the container, that "
       "has the mass."},
      p.height, above(0., 100.));
  list.add({"thickness", "m",
            "Elastic: thickness of the plate, as wide as the container."},
           p.thickness, above(0., 10.));
  list.add({"youngs_modulus", "Pa", "Elastic: E."}, p.youngs_modulus,
           above(0., 1e15));
  list.add({"poisson_ratio", "-", "Elastic: nu."}, p.poisson_ratio,
           Range{0., 0.5, false, true});
  list.add({"density", "kg/m^3", "Elastic: density of the plate itself."},
           p.density, above(0., 3e4));
  list.add({"load_radius", "m",
            "Elastic: all but the plate's own mass, and the forces on it, are "
            "within, spread evenly; they do not stiffen it."},
           p.load_radius, above(0., 100.));
  list.add({"elements", "-",
            "Elastic: cells from the middle of the plate to its rim."},
           p.elements, between(2, 40));
  list.add({"load", "N",
            "Presses on the plate besides its weight and has no mass: a soft "
            "spring."},
           p.load, between(0., 1e9));
  list.add(
      {"seating_speed", "m/s",
       "Speed at which the plate is lowered, the slower the more of it the "
       "particles carry; then it is let go."},
      p.seating_speed, above(0., 10.));
  list.add({"seating_time", "s",
            "Shortest rest of the free plate before it vibrates. It ends when "
            "plate and particles are at rest."},
           p.seating_time, above(0., 1e3));
  list.add({"seating_max_time", "s",
            "The run fails if they are not at rest this long after "
            "seating_time."},
           p.seating_max_time, above(0., 1e4))
      .may_change = true;
  list.add({"seating_load_tolerance", "-",
            "At rest: the load of the particles on the plate differs from its "
            "static load by at most this share."},
           p.seating_load_tolerance, above(0., 0.5));
  list.add({"seating_unbalanced_ratio", "-",
            "At rest: largest unbalanced force ratio."},
           p.seating_unbalanced_ratio, above(0., 0.1));
}

void add_vibration(List &list, VibrationParameters &v)
{
  list.in("Vibration", after_preparation);
  list.add({"eccentric_mass", "kg",
            "Turns at frequency: force m e (2 pi f)^2 sin(2 pi f t) along z."},
           v.eccentric_mass, between(0., 1e6));
  list.add(
      {"eccentricity", "m", "Distance of the eccentric mass from its axis."},
      v.eccentricity, between(0., 10.));
  list.add({"frequency", "Hz", "Frequency of the exciter."}, v.frequency,
           above(0., 1e4));
  list.in("Vibration", {.decides_preparation = false, .may_change = true});
  list.add({"duration", "s", "Duration of the vibration."}, v.duration,
           above(0., 1e6));
  list.add({"reports", "-",
            "Times of vibration in seconds, with blanks between: density, "
            "abrasion and the roundness of every particle are written then."},
           v.reports);
  list.add({"rows_per_period", "-", "Rows of history.csv."}, v.rows_per_period,
           between(1, 1e6));
  list.add({"frames_per_second", "1/s",
            "Frames for ParaView; besides first, last and reports."},
           v.frames_per_second, between(0., 1e5));
  list.add({"checkpoint_every", "-", "Periods; 0: only at the end."},
           v.checkpoint_every, between(0, 1e7));
}
} // namespace

void add_compaction(List &list, Case &of)
{
  add_container(list, of.container);
  add_filling(list, of.filling);
  add_plate(list, of.plate);
  add_vibration(list, of.vibration);
}
} // namespace spall
