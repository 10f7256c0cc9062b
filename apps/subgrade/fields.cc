#include "case/list.h"
#include "subgrade/kind.h"

namespace spall
{
namespace
{
void add_layer(List &list, LayerParameters &l)
{
  list.in("Layer");
  list.add({"length", "m", "Length of the box of the particles, along x."},
           l.length, above(0., 100.));
  list.add({"width", "m", "Width of the box of the particles, along y."},
           l.width, above(0., 100.));
  list.add({"thickness", "m", "Approximate thickness of the layer at rest."},
           l.thickness, above(0., 10.));
  list.add({"solid_fraction", "-",
            "With the box and the thickness: the volume of particles.",
            "random packings stay below 0.75"},
           l.solid_fraction, Range{0., 0.75, true, true});
  add_drawn_particles(list, l);
  list.add(
      {"layers", "-", "Number of layers that are poured one after the other."},
      l.layers, between(1, 1000));
  list.add({"is_tamped", "-",
            "Each layer is tamped until the particles have the solid fraction; "
            "else they just fall."},
           l.is_tamped);
  list.add({"tamper_speed", "m/s", "Speed of the tamping plane."},
           l.tamper_speed, above(0., 10.));
  list.add({"tamper_pressure", "Pa", "Pressure at which the tamper reverses."},
           l.tamper_pressure, above(0., 1e9));
  list.add({"max_strokes", "-", "Most strokes of the tamper on one layer."},
           l.max_strokes, between(1, 1000));
  list.add({"initial_solid_fraction", "-",
            "Solid fraction of the cloud before it falls.",
            "random insertion jams above"},
           l.initial_solid_fraction, above(0., 0.35));
  list.add({"friction", "-",
            "Particle on particle until the plate is placed; low is dense."},
           l.friction, between(0., 10.));
  list.add({"local_damping", "-",
            "D_a: F - D_a |F| sgn(v) until loading begins; then Time/"
            "local_damping."},
           l.local_damping, below(0., 1.));
  list.add({"unbalanced_ratio", "-",
            "Limit for particles at rest: sum of the resultant forces over the "
            "weight."},
           l.unbalanced_ratio, above(0., 0.1));
  list.add({"max_time", "s",
            "For a layer, and for the plate, to come to rest; then the run "
            "fails."},
           l.max_time, above(0., 1e4));
  list.add({"safety", "-",
            "Above 0: share of the stable step while pouring, with the usual "
            "Contact/refresh_tolerance and skin, so that cases with "
            "others and other steps in Time share what is poured; 0: as "
            "Contact and Time say."},
           l.safety, between(0., 1.));
}

void add_plate(List &list, LoadPlateParameters &p)
{
  list.in("LoadPlate", after_preparation);
  list.add({"form", "-", "disc, or block: a sleeper."}, p.form,
           {"disc", "block"});
  list.add({"diameter", "m", "Diameter of a disc."}, p.diameter,
           above(0., 10.));
  list.add({"length", "m", "Length of a block, along x."}, p.length,
           above(0., 10.));
  list.add({"width", "m", "Width of a block, along y."}, p.width,
           above(0., 10.));
  list.add({"height", "m", "Height of the sides of the plate."}, p.height,
           above(0., 10.));
  list.add({"mass", "kg",
            "Mass of the plate or sleeper and of all that moves with it."},
           p.mass, above(0., 1e6));
  list.add({"static_load", "N", "Down on it besides its weight, always."},
           p.static_load, between(0., 1e9));
  list.add({"motion", "-",
            "vertical: guided; free: it moves and turns in all directions."},
           p.motion, {"vertical", "free"});
}

void add_ground(List &list, GroundParameters &g)
{
  list.in("Subgrade", after_preparation);
  list.add_path(
      {"mesh", "-",
       "File of gmsh (.msh) with the hexahedra of the ground in metres, "
       "its top flat at z = 0, a node in the middle of the plate; empty: "
       "a block of cells."},
      g.mesh);
  list.add({"length", "m", "Length of the ground without a mesh, along x."},
           g.length, above(0., 1000.));
  list.add({"width", "m", "Width of the ground without a mesh, along y."},
           g.width, above(0., 1000.));
  list.add(
      {"layers", "-",
       "Layers from the top down, separated by commas, each: thickness (m), "
       "Young's modulus (Pa), Poisson's ratio, density (kg/m^3), and where "
       "it yields: cohesion (Pa), friction angle, dilation angle (degrees; 0 "
       "if left out), as Drucker and Prager say."},
      g.layers);
  list.add({"cell_size", "m", "Size of the elements under the plate."},
           g.cell_size, above(0., 10.));
  list.add({"growth", "-",
            "Growth of the elements from one to the next, away from the "
            "plate."},
           g.growth, between(1., 3.));
  list.add({"bottom", "-",
            "absorbing: dashpots that take waves up, and springs of the "
            "half-space beyond; rigid: held."},
           g.bottom, {"absorbing", "rigid"});
  list.add({"sides", "-",
            "absorbing: as the bottom; rigid: held along their normals."},
           g.sides, {"absorbing", "rigid"});
  list.add({"mass_damping", "1/s", "Rayleigh alpha: force -alpha m v."},
           g.mass_damping, between(0., 1e5));
  list.add({"stiffness_damping", "s", "Rayleigh beta: force -beta K v."},
           g.stiffness_damping, between(0., 1.));
  list.add({"body", "-",
            "full: all its elements move; condensed: the nodes of its top and "
            "the slowest inner modes, implicit, with windows of one length; "
            "without stress in the depth."},
           g.body, {"full", "condensed"});
  list.add({"inner_modes", "-",
            "Modes of the interior that a condensed ground keeps."},
           g.inner_modes, between(0, 10000));
  list.add({"solver", "-",
            "Solver of a full ground at rest and in implicit steps. direct: "
            "factors, "
            "once; amg: conjugate gradients with multigrid, for more than "
            "about 50000 unknowns, whose factors take minutes and gigabytes."},
           g.solver, {"direct", "amg"});
  list.add({"solver_tolerance", "-",
            "amg: residual over right-hand side where it stops."},
           g.solver_tolerance, Range{0., 1e-4, true, false});
}

void add_pulse(List &list, PulseParameters &p)
{
  list.in("Pulse", after_preparation);
  list.add(
      {"form", "-",
       "haversine, sine: cycles at a frequency; train: axles that pass; "
       "table: force over time from a CSV file; eccentric_mass: an exciter "
       "on the plate, m e (2 pi f)^2 sin(2 pi f t)."},
      p.form, {"haversine", "sine", "train", "table", "eccentric_mass"});
  list.add({"amplitude", "N", "Peak of a haversine or a sine, down."},
           p.amplitude, between(0., 1e9));
  list.add(
      {"frequency", "Hz", "Frequency of a haversine, a sine or an exciter."},
      p.frequency, above(0., 1e4));
  list.add({"cycles", "-", "Cycles of a haversine, a sine or an exciter."},
           p.cycles, between(1, 1e7));
  list.add({"eccentric_mass", "kg",
            "m: turns on the plate, whose mass it is part of."},
           p.eccentric_mass, between(0., 1e6));
  list.add({"eccentricity", "m", "e: of the mass from its axis."},
           p.eccentricity, between(0., 10.));
  list.add_path({"table", "-",
                 "CSV file time_s,force_N of the form table: down is positive, "
                 "straight lines between the rows, from time 0, the start of "
                 "loading."},
                p.table);
  list.add({"axle_load", "N", "Load of one axle of the train."}, p.axle_load,
           between(0., 1e9));
  list.add({"axle_spacing", "m", "Distance of the two axles of a bogie."},
           p.axle_spacing, above(0., 1e3));
  list.add({"bogie_spacing", "m",
            "Distance of the centres of the two bogies of a car."},
           p.bogie_spacing, above(0., 1e3));
  list.add({"car_length", "m", "Distance from car to car."}, p.car_length,
           above(0., 1e3));
  list.add({"cars", "-", "Number of cars of the train."}, p.cars,
           between(1, 1e4));
  list.add({"speed", "m/s", "Speed of the train."}, p.speed, above(0., 1e3));
  list.add({"share", "-",
            "Share of an axle load that one sleeper carries: zimmermann, a "
            "rail on an "
            "elastic bed; table: from a CSV file."},
           p.share, {"zimmermann", "table"});
  list.add({"sleeper_spacing", "m", "zimmermann: s."}, p.sleeper_spacing,
           above(0., 100.));
  list.add({"rail_stiffness", "N m^2", "zimmermann: E I of one rail."},
           p.rail_stiffness, above(0., 1e12));
  list.add({"track_modulus", "N/m^2",
            "zimmermann: u of one rail, force per length and deflection."},
           p.track_modulus, above(0., 1e12));
  list.add_path({"share_table", "-",
                 "CSV file distance_m,share_1 of the share table, from 0 on."},
                p.share_table);
  list.add({"rest", "s", "After the last pulse."}, p.rest, between(0., 1e4));
}

void add_record(List &list, RecordParameters &r)
{
  list.in("Record", {.decides_preparation = false, .may_change = true});
  list.add({"row_interval", "s",
            "Time between rows of history.csv while loading; ten times that "
            "before."},
           r.row_interval, above(0., 1e3));
  list.add({"frame_interval", "s", "Time between frames; 0: first and last."},
           r.frame_interval, between(0., 1e6));
  list.add({"checkpoint_interval", "s", "0: only at the end."},
           r.checkpoint_interval, between(0., 1e6));
  list.in("Record", after_preparation);
  list.add({"stress_depths", "m",
            "Below the middle of the plate, where the vertical stress of the "
            "subgrade is written; empty: nowhere."},
           r.stress_depths);
  list.add({"highest_frequency", "Hz", "Highest frequency of transfer.csv."},
           r.highest_frequency, between(0., 1e5))
      .may_change = true;
  list.add(
      {"slices", "-",
       "Slices by height of the particles below the plate in profile.csv."},
      r.slices, between(1, 1000));
}
} // namespace

void add_subgrade(List &list, Case &of)
{
  SubgradeParameters &s = of.subgrade;
  add_layer(list, s.layer);
  add_plate(list, s.plate);
  add_ground(list, s.ground);
  add_pulse(list, s.pulse);
  add_record(list, s.record);
  list.in("GroundContact");
  add_wall(list, s.contact, between(0., 10.), "");
}
} // namespace spall
