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
            "Form of the container. The value rigid is a fixed cylinder with "
            "the contacts of section Wall. The value flexible is a membrane "
            "tube held at both rims, which replaces the mould of the filling."},
           c.form, {"rigid", "flexible"});
  list.add({"diameter", "m",
            "Inner diameter of a container without a mesh file."},
           c.diameter, above(0., 100.), usual_lengths)
      .decides_preparation = true;
  list.add({"height", "m", "Height of the container that the particles fill."},
           c.height, above(0., 100.), usual_lengths)
      .decides_preparation = true;
  list.add({"elements_around", "-",
            "Number of membrane quads around a flexible container. The quads "
            "are about as high as wide."},
           c.elements_around, between(8, 400));
  list.add(
      {"freeboard", "m", "Length of a flexible tube above Container/height."},
      c.freeboard, between(0., 100.));
  list.add({"pressure", "Pa",
            "Outer pressure on a flexible tube, which is applied while the "
            "plate is seated."},
           c.pressure, between(0., 1e8), usual_stresses);
}

void add_filling(List &list, FillingParameters &f)
{
  list.in("Filling");
  add_placed_particles(list, f,
                       "particles are drawn from the gradation. Placed ones "
                       "are one layer, which falls from where it is and is "
                       "tamped.");
  add_drawn_particles(list, f);
  list.add({"density", "kg/m^3",
            "Requested density of the layer: mass of the particles over the "
            "volume that they fill."},
           f.density, above(0., 3e4), usual_densities);
  list.add({"layers", "-",
            "Number of layers that are poured and tamped one by one."},
           f.layers, between(1, 100));
  list.add({"undercompaction", "-",
            "Undercompaction of the first layer: share by which it is left "
            "below the requested density. It falls to zero in the last layer, "
            "since later layers compact the earlier ones."},
           f.undercompaction, below(0., 0.5));
  list.add({"solid_fraction", "-",
            "Solid fraction of the cloud of one layer before it falls.",
            "random insertion jams above"},
           f.solid_fraction, above(0., 0.35));
  list.add({"friction", "-",
            "Friction coefficient between particles at the start of the "
            "filling. High friction gives a loose layer, which the tamper "
            "compacts to the requested density."},
           f.friction, between(0., 10.));
  list.add({"friction_decay", "-",
            "Factor on this friction after each stroke that reaches "
            "tamper_pressure before the requested density, once all particles "
            "are in. The value 1 keeps the friction."},
           f.friction_decay, above(0., 1.));
  list.add({"local_damping", "-",
            "Local damping coefficient D_a while filling. The damped force is "
            "F - D_a |F| sgn(v)."},
           f.local_damping, below(0., 1.));
  list.add({"tamper_speed", "m/s", "Speed of the tamper, downward and upward."},
           f.tamper_speed, above(0., 10.));
  list.add({"tamper_pressure", "Pa",
            "Pressure at which the tamper reverses at any density."},
           f.tamper_pressure, above(0., 1e9), usual_stresses);
  list.add({"max_strokes", "-",
            "Largest number of strokes of the tamper on one layer."},
           f.max_strokes, between(1, 1000));
  list.add({"unbalanced_ratio", "-",
            "Limit for particles at rest: sum of the resultant forces over the "
            "weight."},
           f.unbalanced_ratio, above(0., 0.1));
  list.add({"max_time", "s",
            "Largest time for one layer. The filling fails if a layer takes "
            "longer."},
           f.max_time, above(0., 1e4));
  list.add(
      {"safety", "-",
       "Time step of the filling as a share of the stable step, with the usual "
       "Contact/refresh_tolerance and skin. Cases with other steps in Time can "
       "then share a filling. The value 0 uses Contact and Time."},
      f.safety, between(0., 1.));
}

void add_plate(List &list, PlateParameters &p)
{
  list.in("Plate", after_preparation);
  list.add({"form", "-",
            "Form of the plate. The value rigid moves along z only. The value "
            "tilting also rotates. The value elastic bends about its axis, "
            "which is guided along z, and uses section Coupling."},
           p.form, {"rigid", "tilting", "elastic"});
  list.add({"mass", "kg",
            "Total mass that moves with the plate: plate, static load, and "
            "exciter with its eccentric mass."},
           p.mass, above(0., 1e7));
  list.add({"height", "m",
            "Height of a tilting plate: a solid cylinder as wide as the "
            "container, with the given mass."},
           p.height, above(0., 100.), usual_lengths);
  list.add(
      {"thickness", "m",
       "Thickness of an elastic plate, which is as wide as the container."},
      p.thickness, above(0., 10.));
  list.add({"youngs_modulus", "Pa", "Young's modulus E of an elastic plate."},
           p.youngs_modulus, above(0., 1e15), usual_moduli);
  list.add({"poisson_ratio", "-", "Poisson's ratio nu of an elastic plate."},
           p.poisson_ratio, Range{0., 0.5, false, true});
  list.add({"density", "kg/m^3",
            "Mass density of the material of an elastic plate."},
           p.density, above(0., 3e4), usual_densities);
  list.add({"load_radius", "m",
            "Radius within which all other masses and the forces are spread "
            "evenly on an elastic plate. They do not stiffen it."},
           p.load_radius, above(0., 100.));
  list.add(
      {"elements", "-",
       "Number of elements of an elastic plate from its middle to its rim."},
      p.elements, between(2, 40));
  list.add({"load", "N",
            "Force on the plate in addition to its weight, without mass, as of "
            "a soft spring."},
           p.load, between(0., 1e9));
  list.add(
      {"seating_speed", "m/s",
       "Speed at which the plate is lowered. It decreases with the share of "
       "the plate that the particles carry. Then the plate is released."},
      p.seating_speed, above(0., 10.));
  list.add({"seating_time", "s",
            "Shortest rest of the free plate before it vibrates. The rest ends "
            "when plate and particles are at rest."},
           p.seating_time, above(0., 1e3));
  list.add({"seating_max_time", "s",
            "Largest time to rest after seating_time. The run fails if plate "
            "and particles are not at rest by then."},
           p.seating_max_time, above(0., 1e4))
      .may_change = true;
  list.add({"seating_load_tolerance", "-",
            "Tolerance of rest: largest relative difference between the load "
            "of the particles on the plate and its static load."},
           p.seating_load_tolerance, above(0., 0.5));
  list.add({"seating_unbalanced_ratio", "-",
            "Tolerance of rest: largest unbalanced force ratio."},
           p.seating_unbalanced_ratio, above(0., 0.1));
}

void add_vibration(List &list, VibrationParameters &v)
{
  list.in("Vibration", after_preparation);
  list.add({"eccentric_mass", "kg",
            "Eccentric mass m of the exciter. Its force along z is m e (2 pi "
            "f)^2 sin(2 pi f t)."},
           v.eccentric_mass, between(0., 1e6));
  list.add(
      {"eccentricity", "m", "Distance e of the eccentric mass from its axis."},
      v.eccentricity, between(0., 10.));
  list.add({"frequency", "Hz", "Frequency f of the exciter."}, v.frequency,
           above(0., 1e4));
  list.in("Vibration", {.decides_preparation = false, .may_change = true});
  list.add({"duration", "s", "Duration of the vibration."}, v.duration,
           above(0., 1e6));
  list.add(
      {"reports", "-",
       "Times of vibration in seconds, separated by blanks. Density, abrasion "
       "and the roundness of every particle are written at these times."},
      v.reports);
  list.add({"rows_per_period", "-",
            "Number of rows of history.csv in one period of the exciter."},
           v.rows_per_period, between(1, 1e6));
  list.add({"frames_per_second", "1/s",
            "Number of ParaView frames per second of vibration, in addition to "
            "the first, the last and those of reports."},
           v.frames_per_second, between(0., 1e5));
  list.add({"checkpoint_every", "-",
            "Number of periods between checkpoints. The value 0 writes one at "
            "the end only."},
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
