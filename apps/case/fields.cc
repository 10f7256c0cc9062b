#include "case/fields.h"

#include "case/list.h"

#include <algorithm>

namespace spall
{
namespace
{
void add_particle(List &list, dem::ParticleMaterial &s)
{
  list.in("Particle");
  list.add({"density", "kg/m^3", "Density of the solid, rho."}, s.density,
           above(0., 3e4));
  list.add({"shear_modulus", "Pa", "G of the Hertz contact."}, s.shear_modulus,
           between(1., 1e13));
  list.add({"poisson_ratio", "-", "nu of the Hertz contact."}, s.poisson_ratio,
           below(0., 0.5));
  list.add({"friction", "-", "Coulomb, particle on particle, f."}, s.friction,
           between(0., 10.));
  list.add({"rolling_friction", "-",
            "Rolling resistance, particle on particle, f_r."},
           s.rolling_friction, between(0., 10.));
  list.add({"normal_damping", "-", "Share of critical damping, beta_n."},
           s.normal_damping, between(0., 5.));
  list.add({"shear_damping", "-", "Share of critical damping, beta_s."},
           s.shear_damping, between(0., 5.));
}

/// What the model leaves open; the first name is the article's or the default.
void add_breakage_choices(List &list, dem::BreakageParameters &b)
{
  list.add({"hysteresis", "-",
            "Swings of the energy below this share of it are noise and do not "
            "count."},
           b.hysteresis, below(0., 1.));
  list.add({"contacts", "-",
            "seen: only contacts whose overlap follows the surface break "
            "particles; all: also where equivalent spheres overlap."},
           b.contacts, {"seen", "all"});
  list.add({"energy", "-",
            "Energy of the criterion: the normal spring's, or with the shear "
            "spring's."},
           b.energy, {"normal", "with_shear"});
  list.add({"curvature", "-",
            "Curvature of the cap: the particle's own, or relative to the "
            "other particle."},
           b.curvature, {"own", "relative"});
  list.add({"share", "-",
            "Share of overlap and energy: full for each of two particles, or "
            "by their "
            "compliances (half, if they are alike)."},
           b.share, {"full", "compliance"});
  list.add({"precedence", "-", "Mode of an event that meets both conditions."},
           b.precedence, {"instantaneous", "cumulative"});
  list.add({"sides", "-",
            "Where both particles of a contact ask: the one with the larger "
            "energy ratio, or both."},
           b.sides, {"larger", "both"});
  list.add({"closure", "-",
            "Depth of an event: exact volume, or the article's zero-mean "
            "kernel."},
           b.closure, {"exact", "article"});
  list.add(
      {"memory", "-",
       "Where the cumulative factor of a contact that opens goes: lost with "
       "the contact, or kept by the patch of the particle."},
      b.memory, {"contact", "patch"});
  list.add({"inscribed", "-",
            "Sphere of r_ins, which tells corners: about the origin of the "
            "series, or the largest one inside."},
           b.inscribed, {"origin", "free"});
}

void add_breakage(List &list, dem::BreakageParameters &b)
{
  list.in("Breakage");
  list.add(
      {"is_active", "-", "Particles may break at all, once loading begins."},
      b.is_active);
  list.add({"fracture_energy", "J/m^2", "Breakage energy per area, G_c."},
           b.fracture_energy, above(0., 1e12));
  list.add({"min_equivalent_radius",
            "m",
            "A particle does not break further below this.",
            "",
            {"min_ball_radius"}},
           b.min_equivalent_radius, between(0., 10.));
  list.add(
      {"min_diameter", "m", "Particles below this initial size never break."},
      b.min_diameter, between(0., 10.));
  list.add({"curvature_floor_ratio", "-",
            "beta: curvatures are at least 1 / (beta r_ins)."},
           b.curvature_floor_ratio, between(1., 1e6));
  list.add(
      {"kernel_floor", "-",
       "c: the kernel is at least c / order wide, what the series carries."},
      b.kernel_floor, between(1., 10.));
  list.add({"quadrature_rings", "-",
            "n: 2 n^2 nodes (N_q) measure a particle anew after an event.",
            "exact volumes need 3 order < 2 n"},
           b.quadrature_rings, between(4, 400));
  list.add({"kernel_scale", "-",
            "s: width s sqrt(delta R) of an event; at 1 the curvature halves."},
           b.kernel_scale, between(0.5, 3.));
  add_breakage_choices(list, b);
}

void add_boundary(List &list, BoundaryParameters &b)
{
  list.in("Boundary");
  list.add({"lateral", "-",
            "membrane: deal.II membrane; rigid: four planes, or the side of a "
            "cylinder, under servo control."},
           b.lateral, {"membrane", "rigid"});
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
           b.servo_response_time, above(0., 1.));
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
  list.in("Loading");
  list.add({"form", "-",
            "haversine: cycles of axial stress; compression: the plate goes "
            "down at a constant rate, as in a triaxial compression test, which "
            "counts as one cycle."},
           l.form, {"haversine", "compression"});
  list.add(
      {"confining_pressure", "Pa", "On the lateral sides and on the plate."},
      l.confining_pressure, above(0., 1e8));
  list.add({"amplitude", "Pa", "Peak of the haversine above the confinement."},
           l.amplitude, between(0., 1e9));
  list.add({"frequency", "Hz", "Frequency of the haversine."}, l.frequency,
           above(0., 1e4));
  list.add({"cycles", "-", "Number of load cycles."}, l.cycles,
           between(1, 1e7));
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
           l.consolidation_max_time, above(0., 1e4));
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
  list.in("CycleJump");
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

void add_time(List &list, TimeParameters &t)
{
  list.in("Time");
  list.add({"step", "-",
            "fixed: fixed_step; stable: safety times what the present contacts "
            "allow; error: as stable, and within the two tolerances."},
           t.step, {"fixed", "stable", "error"});
  list.add({"fixed_step", "s", "Time step of the rule fixed."}, t.fixed_step,
           above(0., 1e-2));
  list.add({"safety", "-",
            "Largest share of the stable step, rules stable and error."},
           t.safety, above(0., 1.));
  list.add({"impact_error", "-",
            "Rules stable and error: largest non-conservative work of a Hertz "
            "impact, over its kinetic energy.",
            "an impact needs at least four steps"},
           t.impact_error, between(1e-5, 0.14));
  list.add({"force_tolerance", "-",
            "Rule error: of the boundary forces, root mean square of a load "
            "cycle."},
           t.force_tolerance, above(0., 1.));
  list.add({"energy_tolerance", "-",
            "Rule error: energy residual of a load cycle that the step makes, "
            "over its external work."},
           t.energy_tolerance, above(0., 1.));
  list.add({"local_damping", "-", "D_a: F - D_a |F| sgn(v) while loading."},
           t.local_damping, below(0., 1.));
  list.add({"allow_unstable_step", "-",
            "true: a fixed step above the limit of the present contacts gives "
            "warnings; false: the run fails where loading begins with it."},
           t.allow_unstable_step);
}

void add_output(List &list, OutputParameters &o)
{
  list.in("Output");
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

void add_wall(List &list, dem::WallMaterial &w, const Range &rolling,
              const std::string &reason)
{
  list.add({"normal_stiffness", "N/m", "Linear spring, k_n."},
           w.normal_stiffness, above(0., 1e15));
  list.add({"shear_stiffness", "N/m", "Linear spring, k_s."}, w.shear_stiffness,
           between(0., 1e15));
  list.add({"friction", "-", "Coulomb, particle on boundary, f_w."}, w.friction,
           between(0., 10.));
  list.add({"rolling_friction", "-",
            "Rolling resistance, particle on boundary.", reason},
           w.rolling_friction, rolling);
  list.add({"normal_damping", "-", "Share of critical damping, beta_nw."},
           w.normal_damping, between(0., 5.));
  list.add({"shear_damping", "-", "Share of critical damping, beta_sw."},
           w.shear_damping, between(0., 5.));
}

const std::vector<Section> &sections()
{
  using enum CaseKind;
  static const std::vector<Section> list = {
      {"Case", "What is run."},
      {"Press",
       "Two rigid platens; the upper one comes down.",
       {single_particle}},
      {"Charge", "Particles and steel balls in the drum.", {los_angeles}},
      {"Drum", "The Los Angeles drum and how long it turns.", {los_angeles}},
      {"Container", "What the particles are in.", {vibratory_compaction}},
      {"Filling",
       "The particles, and how they get to their density.",
       {vibratory_compaction}},
      {"Plate",
       "The plate on the particles: rigid, and it may tilt, or elastic.",
       {vibratory_compaction}},
      {"Vibration",
       "The exciter on the plate, and what is written.",
       {vibratory_compaction}},
      {"Layer",
       "The particles on the subgrade, in a box with rigid sides.",
       {subgrade}},
      {"LoadPlate", "The rigid body that loads the particles.", {subgrade}},
      {"Subgrade",
       "The ground, its top at z = 0: elastic, or of layers that yield.",
       {subgrade}},
      {"Pulse", "What the plate or sleeper gets while loading.", {subgrade}},
      {"Record", "What is written, and how often.", {subgrade}},
      {"Specimen", "The particles and the room they fill.", {dynamic_triaxial}},
      {"Preparation",
       "Compaction of the random cloud by servo walls.",
       {dynamic_triaxial}},
      {"Material", "Values of Particle, Wall, MembraneContact and Breakage."},
      {"Particle",
       "Material of the particles: rolling-resistant Hertz contacts between "
       "them. Single particle: its shape, too.",
       {},
       {"Stone"}},
      {"Wall", "Particle against plates, rigid sides, platens and drum."},
      {"MembraneContact",
       "Particle against membrane: linear springs.",
       {dynamic_triaxial, vibratory_compaction}},
      {"Contact", "What counts as overlap."},
      {"Breakage", "Energy criterion of micro-breakage."},
      {"GroundContact",
       "Particle against subgrade: linear springs.",
       {subgrade}},
      {"Membrane",
       "The finite-element membrane round the specimen.",
       {dynamic_triaxial, vibratory_compaction}},
      {"Boundary", "What holds the specimen.", {dynamic_triaxial}},
      {"Coupling",
       "How particles and membrane, subgrade or elastic plate exchange motion "
       "and loads.",
       {dynamic_triaxial, vibratory_compaction, subgrade}},
      {"Loading",
       "Confinement, and what the top plate does.",
       {dynamic_triaxial}},
      {"CycleJump", "Many cycles without simulating each.", {dynamic_triaxial}},
      {"Time", "Time integration."},
      {"Output", "What is written, and how often.", {dynamic_triaxial}},
      {"Run", "The machine."}};
  return list;
}

std::vector<Parameter> parameters_of(Case &of)
{
  List list;
  list.in("Case");
  list.add({"kind", "-", "Kind of test."}, of.kind, kind_names);
  list.add({"title", "-", "Heading of the report."}, of.title);
  add_laboratory(list, of);
  add_compaction(list, of);
  add_subgrade(list, of.subgrade);
  add_specimen(list, of.specimen);
  add_preparation(list, of.preparation);
  list.in("Material");
  list.add(
      {"file", "-",
       "File with any of Particle, Wall, MembraneContact and Breakage; what "
       "the case itself sets wins. "
       "Empty: none."},
      of.material);
  add_particle(list, of.particle);
  list.in("Wall");
  add_law(list,
          {"law", "-",
           "Law of particles on walls: linear, the springs of this section; "
           "hertz, particle on a rigid plate, with the curvatures of the "
           "particle; dmt, Hertz with attraction."},
          of.wall.law);
  add_wall(list, of.wall, between(0., 10.), "");
  add_law_values(list, of.wall_laws);
  list.in("MembraneContact");
  add_wall(list, of.membrane_contact, between(0., 0.),
           "the membrane has no rotational unknowns to take the moment");
  add_contact(list, of);
  add_breakage(list, of.breakage);
  list.in("GroundContact");
  add_wall(list, of.subgrade.contact, between(0., 10.), "");
  add_membrane(list, of.membrane);
  add_boundary(list, of.boundary);
  add_coupling(list, of.coupling);
  add_loading(list, of.loading);
  add_cycle_jump(list, of.cycle_jump);
  add_time(list, of.time);
  add_output(list, of.output);
  list.in("Run");
  list.add({"threads", "-",
            "Most OpenMP threads of the run, 0: all cores; the fastest number "
            "up to it is used."},
           of.threads, between(0, most_threads));
  return std::move(list.parameters);
}

bool is_material_section(const std::string &section)
{
  return section == "Particle" || section == "Wall" ||
         section == "MembraneContact" || section == "Breakage";
}

Case default_case(CaseKind kind)
{
  Case c;
  c.kind = kind;
  if (kind == CaseKind::dynamic_triaxial)
  {
    // Long particles with the rolling friction of the material never come to
    // rest with radii along the branch.
    c.specimen.shapes = "shapes/limestone_blocky";
    c.particle.rolling_friction = 0.5;
    // Without it a sheet rings between the particles: docs/verification/
    // error_of_boundary.md.
    c.membrane.mass_damping = 200.;
    return c;
  }
  if (kind == CaseKind::subgrade)
  {
    set_subgrade_defaults(c);
    return c;
  }
  if (kind == CaseKind::vibratory_compaction)
  {
    c.title = "vibratory compaction test";
    // As in the drum below: particles that are poured spin.
    c.wall.law = "hertz";
    c.contact.geometry = c.contact.wall_geometry = dem::ContactGeometry::sphere;
    c.breakage.contacts = dem::EventContacts::all;
    c.time.step = StepRule::stable;
    // A sleeve that stands 330 kPa from above, not latex.
    c.membrane.youngs_modulus = 1e8;
    c.membrane.thickness = 3e-3;
    return c;
  }
  c.wall.law = "hertz";
  c.contact.wall_geometry = dem::ContactGeometry::radial;
  if (kind == CaseKind::single_particle)
    c.title = "single particle between platens";
  else
  {
    c.title = "Los Angeles abrasion test";
    // Radii along the branch feed particles that spin with energy; balls break
    // particles although their overlaps do not see it.
    c.contact.geometry = c.contact.wall_geometry = dem::ContactGeometry::sphere;
    c.breakage.contacts = dem::EventContacts::all;
    c.time.step = StepRule::stable;
    c.time.local_damping = 0.; // particles fly
  }
  return c;
}
} // namespace spall
