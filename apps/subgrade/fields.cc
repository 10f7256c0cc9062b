#include "case/list.h"
#include "subgrade/kind.h"

namespace spall
{
namespace
{
void add_layer(List &list, LayerParameters &l)
{
  list.in("Layer");
  list.add({"length", "m",
            "Length of the box of the particles along x, without "
            "Container/mesh."},
           l.length, above(0., 100.), usual_lengths);
  list.add({"width", "m",
            "Width of the box of the particles along y, without "
            "Container/mesh."},
           l.width, above(0., 100.), usual_lengths);
  list.add({"thickness", "m",
            "Approximate thickness of the particle layer at rest."},
           l.thickness, above(0., 10.));
  list.add({"solid_fraction", "-",
            "Solid fraction of the layer. Together with the box or container "
            "and the thickness it gives the volume of the particles.",
            "random packings stay below 0.75"},
           l.solid_fraction, Range{0., 0.75, true, true});
  add_placed_particles(list, l,
                       "particles are drawn from the gradation. Placed ones "
                       "are one layer, which falls from where it is and is "
                       "tamped.");
  add_drawn_particles(list, l);
  list.add(
      {"layers", "-", "Number of layers that are poured one after the other."},
      l.layers, between(1, 1000));
  list.add({"is_tamped", "-",
            "Switch for tamping. With true, each layer is tamped to the solid "
            "fraction. With false, the particles only fall."},
           l.is_tamped);
  list.add({"tamper_speed", "m/s", "Speed of the tamper, downward and upward."},
           l.tamper_speed, above(0., 10.));
  list.add({"tamper_pressure", "Pa", "Pressure at which the tamper reverses."},
           l.tamper_pressure, above(0., 1e9), usual_stresses);
  list.add({"max_strokes", "-",
            "Largest number of strokes of the tamper on one layer."},
           l.max_strokes, between(1, 1000));
  list.add({"initial_solid_fraction", "-",
            "Solid fraction of the cloud before it falls.",
            "random insertion jams above"},
           l.initial_solid_fraction, above(0., 0.35));
  list.add({"friction", "-",
            "Friction coefficient between particles until the plate is placed. "
            "Low friction gives a dense layer."},
           l.friction, between(0., 10.));
  list.add({"local_damping", "-",
            "Local damping coefficient D_a until loading begins. The damped "
            "force is F - D_a |F| sgn(v). Then Time/local_damping applies."},
           l.local_damping, below(0., 1.));
  list.add({"unbalanced_ratio", "-",
            "Limit for particles at rest: sum of the resultant forces over the "
            "weight."},
           l.unbalanced_ratio, above(0., 0.1));
  list.add({"max_time", "s",
            "Largest time for a layer, and for the plate, to come to rest. The "
            "run fails after it."},
           l.max_time, above(0., 1e4));
  list.add(
      {"safety", "-",
       "Time step of the pouring as a share of the stable step, with the usual "
       "Contact/refresh_tolerance and skin. Cases with other steps in Time can "
       "then share a layer. The value 0 uses Contact and Time."},
      l.safety, between(0., 1.));
}

void add_plate(List &list, LoadPlateParameters &p)
{
  list.in("LoadPlate", after_preparation);
  list.add({"form", "-",
            "Form of the loading plate: a disc, or a block such as a sleeper."},
           p.form, {"disc", "block"});
  list.add({"diameter", "m", "Diameter of a disc."}, p.diameter,
           above(0., 10.));
  list.add({"length", "m", "Length of a block (sleeper) along x."}, p.length,
           above(0., 10.), usual_lengths);
  list.add({"width", "m", "Width of a block (sleeper) along y."}, p.width,
           above(0., 10.), usual_lengths);
  list.add({"height", "m", "Height of the sides of the plate."}, p.height,
           above(0., 10.));
  list.add({"mass", "kg",
            "Mass of the plate or sleeper and of all that moves with it."},
           p.mass, above(0., 1e6));
  list.add({"static_load", "N",
            "Permanent downward force on the plate in addition to its weight."},
           p.static_load, between(0., 1e9));
  list.add({"motion", "-",
            "Motion of the plate. The value vertical guides it along z. The "
            "value free allows all translations and rotations."},
           p.motion, {"vertical", "free"});
}

void add_ground(List &list, GroundParameters &g)
{
  list.in("Subgrade", after_preparation);
  list.add_path({"mesh", "-",
                 "Mesh of the subgrade: gmsh file (.msh) of hexahedra in "
                 "metres. Its top is flat at z = 0, with a node in the middle "
                 "of the plate. Empty stands for a generated block."},
                g.mesh);
  list.add({"length", "m", "Length of a subgrade without a mesh file along x."},
           g.length, above(0., 1000.), usual_lengths);
  list.add({"width", "m", "Width of a subgrade without a mesh file along y."},
           g.width, above(0., 1000.), usual_lengths);
  list.add({"layers", "-",
            "Layers of the subgrade from the top down, separated by commas. "
            "The values of a layer are thickness (m), Young's modulus (Pa), "
            "Poisson's ratio and density (kg/m^3). A layer that yields "
            "(Drucker-Prager) also has cohesion (Pa), friction angle and "
            "dilation angle (degrees, 0 if omitted)."},
           g.layers);
  list.add({"cell_size", "m", "Size of the elements under the plate."},
           g.cell_size, above(0., 10.));
  list.add(
      {"growth", "-",
       "Ratio of the sizes of neighbouring elements, away from the plate."},
      g.growth, between(1., 3.));
  list.add({"bottom", "-",
            "Boundary condition at the bottom. The value absorbing has "
            "dashpots for outgoing waves and springs of the half-space beyond. "
            "The value rigid is fixed."},
           g.bottom, {"absorbing", "rigid"});
  list.add(
      {"sides", "-",
       "Boundary condition at the sides. The value absorbing is the same as at "
       "the bottom. The value rigid fixes the displacement along the normals."},
      g.sides, {"absorbing", "rigid"});
  list.add(
      {"mass_damping", "1/s",
       "Rayleigh damping coefficient alpha of the mass: force -alpha m v."},
      g.mass_damping, between(0., 1e5));
  list.add(
      {"stiffness_damping", "s",
       "Rayleigh damping coefficient beta of the stiffness: force -beta K v."},
      g.stiffness_damping, between(0., 1.));
  list.add(
      {"body", "-",
       "Model of the subgrade. With full all elements move. With condensed "
       "only the top nodes and the slowest inner modes move, implicitly and in "
       "windows of one length. A condensed subgrade gives no stress at depth."},
      g.body, {"full", "condensed"});
  list.add(
      {"inner_modes", "-", "Number of inner modes of a condensed subgrade."},
      g.inner_modes, between(0, 10000));
  list.add(
      {"solver", "-",
       "Linear solver of a full subgrade at rest and in implicit steps. The "
       "value direct factorises the matrix once. The value amg is the "
       "conjugate gradient method with algebraic multigrid. It suits more than "
       "about 50000 unknowns, whose factors take minutes and gigabytes. The "
       "value distributed_amg is amg with its matrices spread over all MPI "
       "ranks. With it the results of different numbers of ranks agree to "
       "solver_tolerance, and not bit for bit."},
      g.solver, {"direct", "amg", "distributed_amg"});
  list.add({"solver_tolerance", "-",
            "Tolerance of the solvers amg and distributed_amg: residual over "
            "right-hand side."},
           g.solver_tolerance, Range{0., 1e-4, true, false});
}

void add_pulse(List &list, PulseParameters &p)
{
  list.in("Pulse", after_preparation);
  list.add({"form", "-",
            "Form of the load on the plate. The values haversine and sine are "
            "cycles at a frequency. The value train is a sequence of axles. "
            "The value table reads the force over time from a CSV file. The "
            "value eccentric_mass is an exciter on the plate with the force m "
            "e (2 pi f)^2 sin(2 pi f t)."},
           p.form, {"haversine", "sine", "train", "table", "eccentric_mass"});
  list.add({"amplitude", "N", "Peak force of a haversine or a sine, downward."},
           p.amplitude, between(0., 1e9));
  list.add(
      {"frequency", "Hz", "Frequency of a haversine, a sine or an exciter."},
      p.frequency, above(0., 1e4));
  list.add(
      {"cycles", "-", "Number of cycles of a haversine, a sine or an exciter."},
      p.cycles, between(1, 1e7));
  list.add({"pause", "s",
            "Time without load after each cycle of a haversine or a sine."},
           p.pause, between(0., 1e3));
  list.add({"eccentric_mass", "kg",
            "Eccentric mass m of the exciter, which is part of the mass of the "
            "plate."},
           p.eccentric_mass, between(0., 1e6));
  list.add(
      {"eccentricity", "m", "Distance e of the eccentric mass from its axis."},
      p.eccentricity, between(0., 10.));
  list.add_path(
      {"table", "-",
       "CSV file time_s,force_N of the form table, with straight lines between "
       "the rows. Downward force is positive. Time 0 is the start of loading."},
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
  list.add({"speed", "m/s", "Speed of the train."}, p.speed, above(0., 1e3),
           between(0.1, 150.));
  list.add({"share", "-",
            "Share of an axle load that one sleeper carries. The value "
            "zimmermann is a rail on an elastic bed. The value table reads it "
            "from a CSV file."},
           p.share, {"zimmermann", "table"});
  list.add({"sleeper_spacing", "m",
            "Distance s of the sleepers for the share zimmermann."},
           p.sleeper_spacing, above(0., 100.));
  list.add({"rail_stiffness", "N m^2",
            "Bending stiffness E I of one rail for the share zimmermann."},
           p.rail_stiffness, above(0., 1e12));
  list.add({"track_modulus", "N/m^2",
            "Track modulus u of one rail for the share zimmermann: force per "
            "length and deflection."},
           p.track_modulus, above(0., 1e12));
  list.add_path(
      {"share_table", "-",
       "CSV file distance_m,share_1 of the share table, from distance 0 on."},
      p.share_table);
  list.add({"rest", "s", "Time that is simulated after the last pulse."},
           p.rest, between(0., 1e4));
}

void add_record(List &list, RecordParameters &r)
{
  list.in("Record", {.decides_preparation = false, .may_change = true});
  list.add({"row_interval", "s",
            "Time between rows of history.csv while loading. Before the "
            "loading it is ten times as long."},
           r.row_interval, above(0., 1e3));
  list.add({"frame_interval", "s",
            "Time between ParaView frames. The value 0 writes the first and "
            "the last."},
           r.frame_interval, between(0., 1e6));
  list.add(
      {"checkpoint_interval", "s",
       "Time between checkpoints. The value 0 writes one at the end only."},
      r.checkpoint_interval, between(0., 1e6));
  list.in("Record", after_preparation);
  list.add({"stress_depths", "m",
            "Depths below the middle of the plate at which the vertical stress "
            "of the subgrade is written. Empty stands for none."},
           r.stress_depths);
  list.add({"highest_frequency", "Hz", "Highest frequency in transfer.csv."},
           r.highest_frequency, between(0., 1e5))
      .may_change = true;
  list.add({"slices", "-",
            "Number of height slices of the particles below the plate in "
            "profile.csv."},
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
