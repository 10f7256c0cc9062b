#include "case/list.h"
#include "triaxial/kind.h"

namespace spall
{
namespace
{
void add_specimen(List &list, SpecimenParameters &s)
{
  list.in("Specimen");
  list.add({"form", "-",
            "Form of the specimen. The value box is a cube. The value cylinder "
            "is upright, with diameter and height."},
           s.form, {"box", "cylinder"});
  list.add({"side", "m", "Approximate edge of the cube after compaction."},
           s.side, between(1e-3, 100.), usual_lengths);
  list.add({"diameter", "m",
            "Approximate diameter of the cylinder after compaction."},
           s.diameter, between(1e-3, 100.), usual_lengths);
  list.add(
      {"height", "m", "Approximate height of the cylinder after compaction."},
      s.height, between(1e-3, 100.), usual_lengths);
  list.add({"solid_fraction", "-",
            "Volume of the particles over that of the cube or cylinder.",
            "random packings stay below 0.75"},
           s.solid_fraction, Range{0., 0.75, true, true});
  add_placed_particles(list, s,
                       "particles are drawn from the gradation. Placed ones "
                       "are compacted from where they are.");
  add_drawn_particles(list, s);
  list.add({"initial_solid_fraction", "-",
            "Solid fraction of the random cloud before compaction.",
            "random insertion jams above"},
           s.initial_solid_fraction, above(0., 0.35));
}

void add_preparation(List &list, PreparationParameters &p)
{
  list.in("Preparation");
  list.add({"target", "-",
            "Target of the preparation. With pressure the porosity results "
            "from the friction. With porosity the friction is lowered under "
            "the pressure until the porosity is reached, and then restored."},
           p.target, {"pressure", "porosity"});
  list.add({"pressure", "Pa",
            "Isotropic stress of the specimen at the end of the preparation."},
           p.pressure, above(0., 1e8), usual_stresses);
  list.add({"porosity", "-",
            "Porosity of the specimen for target = porosity, which is reached "
            "within 0.005."},
           p.porosity, between(0.2, 0.8));
  list.add({"friction", "-",
            "Friction coefficient between particles during the compaction. Low "
            "friction gives a dense specimen."},
           p.friction, between(0., 10.));
  list.add({"wall_speed", "m/s",
            "Largest speed of a servo-controlled wall during the compaction."},
           p.wall_speed, above(0., 100.));
  list.add({"local_damping", "-",
            "Local damping coefficient D_a during the compaction. The damped "
            "force is F - D_a |F| sgn(v)."},
           p.local_damping, below(0., 1.));
  list.add({"stress_tolerance", "-",
            "Largest relative difference between the stress of each axis and "
            "its target."},
           p.stress_tolerance, above(0., 0.5));
  list.add({"unbalanced_ratio", "-",
            "Largest unbalanced force ratio of a specimen at rest."},
           p.unbalanced_ratio, above(0., 0.1));
  list.add({"max_time", "s",
            "Largest time of the compaction. The run fails if the specimen is "
            "not at rest by then."},
           p.max_time, above(0., 1e4));
  list.add(
      {"safety", "-",
       "Time step of the compaction as a share of the stable step, with the "
       "usual Contact/refresh_tolerance and skin. Cases with other steps in "
       "Time can then share a specimen. The value 0 uses Contact and Time."},
      p.safety, between(0., 1.));
}

void add_boundary(List &list, BoundaryParameters &b)
{
  list.in("Boundary", after_preparation);
  list.add({"lateral", "-",
            "Lateral boundary of the specimen. The value membrane is a "
            "finite-element membrane. The value rigid has four planes, or the "
            "side of a cylinder, under servo control. The value periodic joins "
            "opposite sides of the box from the preparation on, at a distance "
            "under servo control."},
           b.lateral, {"membrane", "rigid", "periodic"});
  list.add_path({"mesh", "-",
                 "Mesh of the membrane: gmsh file (.msh) of quads on the side "
                 "of an upright box or of a cylinder around the z axis. It is "
                 "stretched to the specimen. Empty stands for equal quads."},
                b.mesh);
  list.add({"elements_per_side", "-",
            "Number of membrane quads along each edge of a box without a mesh "
            "file."},
           b.elements_per_side, between(2, 200));
  list.add({"elements_around", "-",
            "Number of membrane quads around a cylinder without a mesh file. "
            "The quads are about as high as wide."},
           b.elements_around, between(6, 1000));
  list.add({"refined", "-",
            "Refinement of the membrane. With none all quads keep their size. "
            "With pressed the quads that particles touch at the start of the "
            "membrane are halved in both directions."},
           b.refined, {"none", "pressed"});
  list.add({"servo_response_time", "s",
            "Time in which servo-controlled sides reduce a stress error to "
            "1/e."},
           b.servo_response_time, above(0., 1.))
      .decides_preparation = true;
  list.add({"servo_yielding", "-",
            "Feed-forward of rigid sides under load: their rate over the rate "
            "at which the plate shortens the specimen. With the value 0 they "
            "react to a stress error only."},
           b.servo_yielding, between(0., 0.5));
  list.add({"servo_dead_band", "-",
            "Dead band of rigid sides under load. Stress errors up to this "
            "share of the pressure do not move them."},
           b.servo_dead_band, between(0., 0.5));
  list.add({"plate_mass", "kg", "Mass of the top plate."}, b.plate_mass,
           above(0., 1e6));
}

void add_loading(List &list, LoadingParameters &l)
{
  list.in("Loading", after_preparation);
  list.add(
      {"form", "-",
       "Form of the axial loading. The value haversine applies cycles of axial "
       "stress. The value compression lowers the plate at a constant rate and "
       "counts as one cycle. The value path follows the stages of a file."},
      l.form, {"haversine", "compression", "path"});
  // Triaxial::restore() compares the stages that have begun.
  list.add_path({"path", "-",
                 "CSV file of form = path, with a row for each stage. A "
                 "resumed run may have more stages at its end."},
                l.path)
      .may_change = true;
  list.add({"confining_pressure", "Pa",
            "Confining pressure on the lateral sides and on the plate."},
           l.confining_pressure, above(0., 1e8), usual_stresses);
  list.add({"amplitude", "Pa",
            "Peak of the haversine stress above the confining pressure."},
           l.amplitude, between(0., 1e9), usual_stresses);
  list.add({"frequency", "Hz", "Frequency of the haversine."}, l.frequency,
           above(0., 1e4));
  list.add({"cycles", "-", "Number of load cycles."}, l.cycles, between(1, 1e7))
      .may_change = true;
  list.add({"strain_rate", "1/s",
            "Axial strain rate of a compression, relative to the height of the "
            "specimen."},
           l.strain_rate, above(0., 1e4));
  list.add({"final_strain", "-", "Axial strain at the end of a compression."},
           l.final_strain, between(1e-6, 0.5));
  list.add({"consolidation_time", "s",
            "Shortest consolidation at the confining pressure before cycle 1. "
            "It ends when the specimen is at rest."},
           l.consolidation_time, between(0., 1e3));
  list.add({"consolidation_max_time", "s",
            "Largest time to rest after consolidation_time. The run fails if "
            "the specimen is not at rest by then."},
           l.consolidation_max_time, above(0., 1e4))
      .may_change = true;
  list.add({"consolidation_stress_tolerance", "-",
            "Tolerance of rest: largest relative difference of the plate load "
            "and the stress on rigid sides from the confining pressure."},
           l.consolidation_stress_tolerance, above(0., 0.5));
  list.add({"consolidation_unbalanced_ratio", "-",
            "Tolerance of rest: largest unbalanced force ratio."},
           l.consolidation_unbalanced_ratio, above(0., 0.1));
}

void add_cycle_jump(List &list, coupling::CycleJumpParameters &j)
{
  list.in("CycleJump", after_preparation);
  list.add({"tolerance", "-",
            "Relative tolerance of the permanent strain and the abrasion after "
            "each jump over load cycles. The value 0 simulates every cycle."},
           j.tolerance, below(0., 1.));
  list.add(
      {"first", "-",
       "Number of cycles that are simulated before the growth is observed."},
      j.first, between(1, 1e6));
  list.add(
      {"observed", "-",
       "Number of cycles before and after a jump whose growth is compared."},
      j.observed, between(2, 1e4));
  list.add({"settled", "-",
            "Number of cycles after a jump before growth is observed again. "
            "Particles that have just broken carry less load at first."},
           j.settled, between(0, 1e4));
  list.add({"longest", "-", "Largest number of cycles that one jump skips."},
           j.longest, between(2, 1e6));
}

void add_output(List &list, OutputParameters &o)
{
  list.in("Output", {.decides_preparation = false, .may_change = true});
  list.add({"samples_per_cycle", "-",
            "Number of rows of history.csv per cycle.",
            "fewer miss the peak of a cycle"},
           o.samples_per_cycle, between(10, 1e6));
  list.add({"frames_per_cycle", "-",
            "Number of ParaView frames per cycle. The value 0 writes the first "
            "and the last."},
           o.frames_per_cycle, between(0, 1e4));
  list.add({"checkpoint_every", "-",
            "Number of cycles between checkpoints. The value 0 writes one at "
            "the end only."},
           o.checkpoint_every, between(0, 1e7));
  list.add({"surfaces", "-",
            "Frames that hold the true surfaces of the particles: none, the "
            "first and the last (ends), or all."},
           o.surfaces, {"none", "ends", "all"});
}
} // namespace

void add_triaxial(List &list, Case &of)
{
  add_specimen(list, of.specimen);
  add_preparation(list, of.preparation);
  add_boundary(list, of.boundary);
  add_loading(list, of.loading);
  add_cycle_jump(list, of.cycle_jump);
  add_output(list, of.output);
  list.in("Time");
  list.add({"density_scaling_diameter", "m",
            "Diameter of density scaling. Smaller particles get the inertia of "
            "this diameter (twice the equivalent radius) and do not limit the "
            "stable step. The value 0 switches density scaling off."},
           of.time.density_scaling_diameter, between(0., 10.));
}
} // namespace spall
