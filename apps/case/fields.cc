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
  list.add(
      {"density", "kg/m^3", "Mass density rho of the solid of the particles."},
      s.density, above(0., 3e4), usual_densities);
  list.add({"shear_modulus", "Pa",
            "Shear modulus G of the particles in the Hertz contact law."},
           s.shear_modulus, between(1., 1e13), usual_moduli);
  list.add({"poisson_ratio", "-",
            "Poisson's ratio nu of the particles in the Hertz contact law."},
           s.poisson_ratio, below(0., 0.5));
  list.add(
      {"friction", "-", "Coulomb friction coefficient f between particles."},
      s.friction, between(0., 10.));
  list.add({"rolling_friction", "-",
            "Rolling friction coefficient f_r between particles."},
           s.rolling_friction, between(0., 10.));
  list.add({"normal_damping", "-",
            "Normal damping ratio beta_n between particles, as a share of "
            "critical damping."},
           s.normal_damping, between(0., 5.));
  list.add({"shear_damping", "-",
            "Shear damping ratio beta_s between particles, as a share of "
            "critical damping."},
           s.shear_damping, between(0., 5.));
}

/// What the model leaves open; the first name is the article's or the default.
void add_breakage_choices(List &list, dem::BreakageParameters &b)
{
  list.add({"hysteresis", "-",
            "Relative threshold of reversals of the contact energy. Smaller "
            "reversals are noise and are not counted."},
           b.hysteresis, below(0., 1.));
  list.add({"contacts", "-",
            "Contacts that can break particles. The value seen takes only "
            "contacts whose overlap follows the surface. The value all also "
            "takes overlaps of equivalent spheres."},
           b.contacts, {"seen", "all"});
  list.add({"energy", "-",
            "Energy in the breakage criterion: that of the normal spring "
            "(normal), or of the normal and the shear spring (with_shear)."},
           b.energy, {"normal", "with_shear"});
  list.add({"curvature", "-",
            "Curvature of the removed cap: that of the particle itself (own), "
            "or relative to the other particle (relative)."},
           b.curvature, {"own", "relative"});
  list.add(
      {"share", "-",
       "Share of overlap and energy that counts for each of two particles. The "
       "value full counts all for each. The value compliance divides by their "
       "compliances, half for equal particles."},
      b.share, {"full", "compliance"});
  list.add(
      {"precedence", "-",
       "Mode of a breakage event that meets both conditions of the criterion."},
      b.precedence, {"instantaneous", "cumulative"});
  list.add({"sides", "-",
            "Particle that breaks where both particles of a contact meet the "
            "criterion. The value larger takes the one with the larger energy "
            "ratio. The value both takes both."},
           b.sides, {"larger", "both"});
  list.add(
      {"closure", "-",
       "Depth of a breakage event. The value exact uses the exact removed "
       "volume. The value article uses the zero-mean kernel of the article."},
      b.closure, {"exact", "article"});
  list.add({"memory", "-",
            "Memory of the cumulative factor when a contact opens. The value "
            "contact discards it with the contact. The value patch keeps it on "
            "the patch of the particle surface."},
           b.memory, {"contact", "patch"});
  list.add({"inscribed", "-",
            "Inscribed sphere of radius r_ins, which identifies corners. The "
            "value origin centres it at the origin of the series. The value "
            "free takes the largest sphere inside the particle."},
           b.inscribed, {"origin", "free"})
      .decides_preparation = true;
}

void add_breakage(List &list, dem::BreakageParameters &b)
{
  list.in("Breakage", after_preparation);
  list.add({"is_active", "-",
            "Switch for breakage. With true, particles can break from the "
            "start of loading."},
           b.is_active);
  list.add({"fracture_energy", "J/m^2", "Breakage energy G_c per unit area."},
           b.fracture_energy, above(0., 1e12));
  list.add({"min_equivalent_radius",
            "m",
            "Smallest equivalent radius of a particle that can break further.",
            "",
            {"min_ball_radius"}},
           b.min_equivalent_radius, between(0., 10.));
  // Which particles may break belongs to the particle, and so does its smallest
  // sphere; the floor of curvatures is also that of the contacts' stiffness.
  list.add({"min_diameter", "m",
            "Smallest initial diameter of a breakable particle. Smaller "
            "particles never break."},
           b.min_diameter, between(0., 10.))
      .decides_preparation = true;
  list.add({"curvature_floor_ratio", "-",
            "Ratio beta of the lower limit of curvature. Curvatures are at "
            "least 1 / (beta r_ins)."},
           b.curvature_floor_ratio, between(1., 1e6))
      .decides_preparation = true;
  list.add({"kernel_floor", "-",
            "Coefficient c of the smallest kernel width. The kernel is at "
            "least c / order wide, which the series can resolve."},
           b.kernel_floor, between(1., 10.));
  list.add({"quadrature_rings", "-",
            "Number n of quadrature rings. A particle is measured on 2 n^2 "
            "nodes (N_q) after each breakage event.",
            "exact volumes need 3 order < 2 n"},
           b.quadrature_rings, between(4, 400))
      .decides_preparation = true;
  list.add({"kernel_scale", "-",
            "Scale s of the width s sqrt(delta R) of a breakage event. With "
            "the value 1 the curvature halves."},
           b.kernel_scale, between(0.5, 3.));
  add_breakage_choices(list, b);
}

void add_time(List &list, TimeParameters &t)
{
  list.in("Time");
  list.add({"step", "-",
            "Rule of the time step. The value fixed uses fixed_step. The value "
            "stable uses safety times the stable step of the present contacts. "
            "The value error also meets the two tolerances."},
           t.step, {"fixed", "stable", "error"});
  list.add({"fixed_step", "s", "Time step of the rule fixed."}, t.fixed_step,
           above(0., 1e-2));
  list.add({"safety", "-",
            "Largest time step of the rules stable and error, as a share of "
            "the stable step."},
           t.safety, above(0., 1.));
  list.add({"impact_error", "-",
            "Largest non-conservative work of a Hertz impact over its kinetic "
            "energy, for the rules stable and error.",
            "an impact needs at least four steps"},
           t.impact_error, between(1e-5, 0.14));
  list.add({"force_tolerance", "-",
            "Tolerance of the rule error for the boundary forces: relative "
            "root mean square error over a load cycle."},
           t.force_tolerance, above(0., 1.))
      .decides_preparation = false;
  list.add({"energy_tolerance", "-",
            "Tolerance of the rule error for the energy: residual of a load "
            "cycle due to the time step, over its external work."},
           t.energy_tolerance, above(0., 1.))
      .decides_preparation = false;
  list.add({"local_damping", "-",
            "Local damping coefficient D_a while loading. The damped force is "
            "F - D_a |F| sgn(v)."},
           t.local_damping, below(0., 1.))
      .decides_preparation = false;
  list.in("Time", {.decides_preparation = false, .may_change = true});
  list.add({"allow_unstable_step", "-",
            "Treatment of a fixed step above the stable step of the present "
            "contacts. With true, the run gives warnings. With false, it fails "
            "at the start of loading."},
           t.allow_unstable_step);
}

} // namespace

void add_wall(List &list, dem::WallMaterial &w, const Range &rolling,
              const std::string &reason)
{
  list.add({"normal_stiffness", "N/m",
            "Normal stiffness k_n of the linear spring between particle and "
            "boundary."},
           w.normal_stiffness, above(0., 1e15));
  list.add({"shear_stiffness", "N/m",
            "Shear stiffness k_s of the linear spring between particle and "
            "boundary."},
           w.shear_stiffness, between(0., 1e15));
  list.add({"friction", "-",
            "Coulomb friction coefficient f_w between particle and boundary."},
           w.friction, between(0., 10.));
  list.add({"rolling_friction", "-",
            "Rolling friction coefficient between particle and boundary.",
            reason},
           w.rolling_friction, rolling);
  list.add({"normal_damping", "-",
            "Normal damping ratio beta_nw between particle and boundary, as a "
            "share of critical damping."},
           w.normal_damping, between(0., 5.));
  list.add({"shear_damping", "-",
            "Shear damping ratio beta_sw between particle and boundary, as a "
            "share of critical damping."},
           w.shear_damping, between(0., 5.));
}

namespace
{
void add_container_mesh(List &list, ContainerParameters &c)
{
  list.in("Container");
  list.add_path(
      {"mesh", "-",
       "Triangle mesh of the inner surface of a rigid container: STL, PLY, "
       "OBJ or gmsh file. It is open at a flat rim, or closed there by a flat "
       "lid, which is taken off. Its lowest point is moved to z = 0. In a "
       "compaction it replaces the cylinder and its floor. In a subgrade test "
       "it replaces the sides of the box. A second rim stands flat on the "
       "subgrade; a flat floor there is taken off. Empty stands for the "
       "cylinder or the box."},
      c.mesh);
  list.add({"scale", "m", "Length of one unit of the mesh file."}, c.scale,
           above(0., 1e3));
}

struct CommonSection
{
  Section section;
  bool is_shared = false; ///< by some kinds; else every kind has it
};

const std::vector<CommonSection> common_sections = {
    {{"Container",
      "Container of the particles; in a subgrade test its sides alone."},
     true},
    {{"Material",
      "Material file with values of Particle, Wall, MembraneContact and "
      "Breakage."}},
    {{"Particle",
      "Material of the particles and of the contacts between them. In a single "
      "particle test the section also holds the shape of the particle.",
      {"Stone"}}},
    {{"Wall",
      "Contact of the particles with rigid boundaries: plates, rigid sides, "
      "platens and drum."}},
    {{"MembraneContact",
      "Contact of the particles with the membrane by linear springs."},
     true},
    {{"Contact",
      "Geometry and law of the contacts, and limits of the overlap."}},
    {{"Breakage", "Energy criterion of the breakage of particles."}},
    {{"Membrane", "Finite-element membrane around the specimen."}, true},
    {{"Coupling",
      "Exchange of motion and loads between the particles and a deformable "
      "body: membrane, subgrade or elastic plate."},
     true},
    {{"Time", "Time integration and time step."}},
    {{"Output", "Output files and their intervals."}},
    {{"Run", "Threads of the run."}}};

/// The kinds that have a shared section.
std::vector<std::string> kinds_with(const std::string &section)
{
  std::vector<std::string> names;
  for (const TestKind &kind : test_kinds())
    if (std::ranges::find(kind.shared_sections, section) !=
        kind.shared_sections.end())
      names.push_back(kind.name);
  return names;
}
} // namespace

std::vector<ListedSection> sections(const Case &of)
{
  std::vector<ListedSection> all = {
      {{"Case", "Kind and title of the case."}, {}}};
  for (const TestKind &kind : test_kinds())
    for (const Section &section : kind.sections)
      all.push_back({section, {kind.name}});
  for (const CommonSection &common : common_sections)
    all.push_back({common.section, common.is_shared
                                       ? kinds_with(common.section.name)
                                       : std::vector<std::string>{}});
  for (const WallSection &wall : of.walls)
    all.push_back({{wall.section(), "Rigid wall " + wall.name +
                                        ": a triangle mesh at rest or in "
                                        "motion."},
                   kinds_with("Walls")});
  return all;
}

std::vector<Parameter> parameters_of(Case &of)
{
  List list;
  list.in("Case", after_preparation);
  list.add_name({"kind", "-", "Kind of test of the case."}, of.kind,
                kind_names());
  list.add({"title", "-", "Title of the case and heading of its report."},
           of.title)
      .may_change = true;
  for (const TestKind &kind : test_kinds())
  {
    list.only_of(kind.name);
    kind.add_parameters(list, of);
  }
  list.only_of("");
  add_container_mesh(list, of.container);
  // Its values are in their sections.
  list.in("Material", {.decides_preparation = false, .may_change = true});
  list.add({"file", "-",
            "Material file with any of the sections Particle, Wall, "
            "MembraneContact and Breakage. Values set in the case itself take "
            "precedence. Empty stands for no material file."},
           of.material);
  add_particle(list, of.particle);
  list.in("Wall");
  add_law(list,
          {"law", "-",
           "Contact law of particles on walls. The value linear uses the "
           "springs of this section. The value hertz treats the wall as a "
           "rigid plate, with the curvatures of the particle. The value dmt "
           "adds attraction to hertz."},
          of.wall.law);
  add_wall(list, of.wall, between(0., 10.), "");
  add_law_values(list, of.wall_laws);
  list.in("MembraneContact", after_preparation);
  add_wall(list, of.membrane_contact, between(0., 0.),
           "the membrane has no rotational unknowns to take the moment");
  add_contact(list, of);
  add_breakage(list, of.breakage);
  add_membrane(list, of.membrane);
  add_coupling(list, of.coupling);
  add_time(list, of.time);
  list.in("Output", {.decides_preparation = false, .may_change = true});
  list.add({"frame_tables", "-",
            "Tables of the particles and contacts of every frame in addition "
            "to the ParaView files: none, or an HDF5 file (hdf5)."},
           of.output.frame_tables, {"none", "hdf5"});
  list.add({"pieces_above", "-",
            "Number of particles above which a run on several ranks writes its "
            "ParaView files in pieces. Each rank writes its particles and "
            "contacts, and an index (pvtu) joins them."},
           of.output.pieces_above, between(0, 2e9));
  list.in("Run", {.decides_preparation = false, .may_change = true});
  list.add({"threads", "-",
            "Largest number of OpenMP threads. The run uses the fastest number "
            "up to it. The value 0 allows all cores."},
           of.threads, between(0, most_threads));
  add_walls(list, of.walls);
  return std::move(list.parameters);
}

bool is_material_section(const std::string &section)
{
  return section == "Particle" || section == "Wall" ||
         section == "MembraneContact" || section == "Breakage";
}

Case default_case(const std::string &kind)
{
  Case defaults;
  defaults.kind = kind;
  find_kind(kind)->set_defaults(defaults);
  return defaults;
}

Case defaults_of(const Case &of)
{
  Case defaults = default_case(of.kind);
  for (const WallSection &wall : of.walls)
    defaults.walls.emplace_back().name = wall.name;
  return defaults;
}
} // namespace spall
