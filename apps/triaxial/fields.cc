#include "case/list.h"
#include "triaxial/kind.h"

namespace spall
{
namespace
{
void add_specimen(List &list, SpecimenParameters &s)
{
  list.in("Specimen");
  list.add({"form", "-", "box: a cube; cylinder: upright, diameter by height."},
           s.form, {"box", "cylinder"});
  list.add({"side", "m", "Edge of the cube after compaction, about."}, s.side,
           between(1e-3, 100.));
  list.add({"diameter", "m",
            "Approximate diameter of the cylinder after compaction."},
           s.diameter, between(1e-3, 100.));
  list.add(
      {"height", "m", "Approximate height of the cylinder after compaction."},
      s.height, between(1e-3, 100.));
  list.add({"solid_fraction", "-",
            "Volume of the particles over that of the cube or cylinder.",
            "random packings stay below 0.75"},
           s.solid_fraction, Range{0., 0.75, true, true});
  list.add_path({"particles", "-",
                 "CSV file of placed particles, or the folder of a run of kind "
                 "scene, which are compacted from there instead of particles "
                 "drawn from the gradation. Columns as in Scene/particles. "
                 "Empty: none."},
                s.particles);
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
            "pressure: at rest at the pressure, as dense as friction makes it; "
            "porosity: under the pressure friction is lowered until the "
            "porosity is met, then set back."},
           p.target, {"pressure", "porosity"});
  list.add({"pressure", "Pa", "Isotropic, at the end of the compaction."},
           p.pressure, above(0., 1e8));
  list.add({"porosity", "-", "Porosity of target = porosity, met to 0.005."},
           p.porosity, between(0.2, 0.8));
  list.add(
      {"friction", "-", "Particle on particle while compacting; low is dense."},
      p.friction, between(0., 10.));
  list.add({"wall_speed", "m/s", "Largest speed of a servo wall."},
           p.wall_speed, above(0., 100.));
  list.add({"local_damping", "-", "D_a: F - D_a |F| sgn(v) while compacting."},
           p.local_damping, below(0., 1.));
  list.add({"stress_tolerance", "-",
            "Stress of each axis may differ from the target by this share."},
           p.stress_tolerance, above(0., 0.5));
  list.add({"unbalanced_ratio", "-",
            "Largest unbalanced force ratio of a specimen at rest."},
           p.unbalanced_ratio, above(0., 0.1));
  list.add(
      {"max_time", "s", "The compaction fails if it is not at rest by then."},
      p.max_time, above(0., 1e4));
  list.add(
      {"safety", "-",
       "Above 0: share of the stable step while compacting, with the usual "
       "Contact/refresh_tolerance and skin, so that cases with "
       "others and other steps in Time share a specimen; 0: as Contact and "
       "Time say."},
      p.safety, between(0., 1.));
}

void add_boundary(List &list, BoundaryParameters &b)
{
  list.in("Boundary", after_preparation);
  list.add({"lateral", "-",
            "membrane: deal.II membrane; rigid: four planes, or the side of a "
            "cylinder, under servo control; periodic: no walls, opposite sides "
            "of the box are one, from the preparation on, and their distance "
            "is under servo control."},
           b.lateral, {"membrane", "rigid", "periodic"});
  list.add_path(
      {"mesh", "-",
       "File of gmsh (.msh) with the quads of the membrane: the side of "
       "an upright box, or of a cylinder round the z axis, which is "
       "stretched to the specimen; empty: equal quads."},
      b.mesh);
  list.add({"elements_per_side", "-",
            "Membrane quads along each edge of a box without a mesh."},
           b.elements_per_side, between(2, 200));
  list.add({"elements_around", "-",
            "Membrane quads round a cylinder without a mesh; along it "
            "they are about "
            "as long."},
           b.elements_around, between(6, 1000));
  list.add(
      {"refined", "-",
       "none: all quads as they are; pressed: those that particles press on "
       "when the membrane takes over are halved both ways."},
      b.refined, {"none", "pressed"});
  list.add({"servo_response_time", "s",
            "Time in which servo planes reduce a stress error to 1/e."},
           b.servo_response_time, above(0., 1.))
      .decides_preparation = true;
  list.add({"servo_yielding", "-",
            "Yielding of rigid sides under load: their rate over "
            "that at which the plate shortens the specimen; 0: they wait for "
            "an error."},
           b.servo_yielding, between(0., 0.5));
  list.add(
      {"servo_dead_band", "-",
       "Dead band of rigid sides under load: errors up to this share of the "
       "pressure do not move them."},
      b.servo_dead_band, between(0., 0.5));
  list.add({"plate_mass", "kg", "Mass of the top plate."}, b.plate_mass,
           above(0., 1e6));
}

void add_loading(List &list, LoadingParameters &l)
{
  list.in("Loading", after_preparation);
  list.add({"form", "-",
            "haversine: cycles of axial stress; compression: the plate goes "
            "down at a constant rate, as in a triaxial compression test, which "
            "counts as one cycle; path: the stages of a file."},
           l.form, {"haversine", "compression", "path"});
  // Triaxial::restore() compares the stages that have begun.
  list.add_path({"path", "-",
                 "CSV file of form = path: a row for each stage. A resumed run "
                 "may have more stages at its end."},
                l.path)
      .may_change = true;
  list.add(
      {"confining_pressure", "Pa", "On the lateral sides and on the plate."},
      l.confining_pressure, above(0., 1e8));
  list.add({"amplitude", "Pa", "Peak of the haversine above the confinement."},
           l.amplitude, between(0., 1e9));
  list.add({"frequency", "Hz", "Frequency of the haversine."}, l.frequency,
           above(0., 1e4));
  list.add({"cycles", "-", "Number of load cycles."}, l.cycles, between(1, 1e7))
      .may_change = true;
  list.add({"strain_rate", "1/s", "Rate of a compression, over the height."},
           l.strain_rate, above(0., 1e4));
  list.add({"final_strain", "-", "At the end of a compression."},
           l.final_strain, between(1e-6, 0.5));
  list.add({"consolidation_time", "s",
            "Shortest consolidation at the confinement before cycle 1. It ends "
            "when the specimen is at rest."},
           l.consolidation_time, between(0., 1e3));
  list.add({"consolidation_max_time", "s",
            "The run fails if the specimen is not at rest this long after "
            "consolidation_time."},
           l.consolidation_max_time, above(0., 1e4))
      .may_change = true;
  list.add({"consolidation_stress_tolerance", "-",
            "At rest: the load on the plate and the stress on rigid sides "
            "differ from the confinement by at most this share."},
           l.consolidation_stress_tolerance, above(0., 0.5));
  list.add({"consolidation_unbalanced_ratio", "-",
            "At rest: largest unbalanced force ratio."},
           l.consolidation_unbalanced_ratio, above(0., 0.1));
}

void add_cycle_jump(List &list, coupling::CycleJumpParameters &j)
{
  list.in("CycleJump", after_preparation);
  list.add({"tolerance", "-",
            "Jumps over load cycles as long as each brings permanent strain "
            "and abrasion within this share of what there is; 0: every cycle "
            "is simulated."},
           j.tolerance, below(0., 1.));
  list.add({"first", "-", "Cycles that are simulated before any is observed."},
           j.first, between(1, 1e6));
  list.add({"observed", "-",
            "Cycles before and after a jump whose growth is compared."},
           j.observed, between(2, 1e4));
  list.add({"settled", "-",
            "Cycles after a jump before growth is observed again: what has "
            "just broken bears less for some."},
           j.settled, between(0, 1e4));
  list.add({"longest", "-", "Cycles that a jump skips at most."}, j.longest,
           between(2, 1e6));
}

void add_output(List &list, OutputParameters &o)
{
  list.in("Output", {.decides_preparation = false, .may_change = true});
  list.add({"samples_per_cycle", "-", "Rows of history.csv.",
            "fewer miss the peak of a cycle"},
           o.samples_per_cycle, between(10, 1e6));
  list.add({"frames_per_cycle", "-", "Frames for ParaView; 0: first and last."},
           o.frames_per_cycle, between(0, 1e4));
  list.add({"checkpoint_every", "-", "Cycles; 0: only at the end."},
           o.checkpoint_every, between(0, 1e7));
  list.add(
      {"surfaces", "-", "True surfaces of the particles: in which frames."},
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
            "Density scaling: the inertia of smaller particles is raised to "
            "that of this diameter, twice the equivalent radius, so that they "
            "do not set the stable step; 0: none."},
           of.time.density_scaling_diameter, between(0., 10.));
}
} // namespace spall
