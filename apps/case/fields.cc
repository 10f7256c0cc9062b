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
           b.inscribed, {"origin", "free"})
      .decides_preparation = true;
}

void add_breakage(List &list, dem::BreakageParameters &b)
{
  list.in("Breakage", after_preparation);
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
  // Which particles may break belongs to the particle, and so does its smallest
  // sphere; the floor of curvatures is also that of the contacts' stiffness.
  list.add({"min_diameter", "m",
            "Particles below this initial size never break."},
           b.min_diameter, between(0., 10.))
      .decides_preparation = true;
  list.add({"curvature_floor_ratio", "-",
            "beta: curvatures are at least 1 / (beta r_ins)."},
           b.curvature_floor_ratio, between(1., 1e6))
      .decides_preparation = true;
  list.add(
      {"kernel_floor", "-",
       "c: the kernel is at least c / order wide, what the series carries."},
      b.kernel_floor, between(1., 10.));
  list.add({"quadrature_rings", "-",
            "n: 2 n^2 nodes (N_q) measure a particle again after an event.",
            "exact volumes need 3 order < 2 n"},
           b.quadrature_rings, between(4, 400))
      .decides_preparation = true;
  list.add({"kernel_scale", "-",
            "s: width s sqrt(delta R) of an event; at 1 the curvature halves."},
           b.kernel_scale, between(0.5, 3.));
  add_breakage_choices(list, b);
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
           t.force_tolerance, above(0., 1.))
      .decides_preparation = false;
  list.add({"energy_tolerance", "-",
            "Rule error: energy residual of a load cycle that the step makes, "
            "over its external work."},
           t.energy_tolerance, above(0., 1.))
      .decides_preparation = false;
  list.add({"local_damping", "-", "D_a: F - D_a |F| sgn(v) while loading."},
           t.local_damping, below(0., 1.))
      .decides_preparation = false;
  list.in("Time", {.decides_preparation = false, .may_change = true});
  list.add({"allow_unstable_step", "-",
            "true: a fixed step above the limit of the present contacts gives "
            "warnings; false: the run fails where loading begins with it."},
           t.allow_unstable_step);
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

namespace
{
struct CommonSection
{
  Section section;
  bool is_shared = false; ///< by some kinds; else every kind has it
};

const std::vector<CommonSection> common_sections = {
    {{"Material", "Values of Particle, Wall, MembraneContact and Breakage."}},
    {{"Particle",
      "Material of the particles: rolling-resistant Hertz contacts between "
      "them. Single particle: its shape, too.",
      {"Stone"}}},
    {{"Wall", "Particle against plates, rigid sides, platens and drum."}},
    {{"MembraneContact", "Particle against membrane: linear springs."}, true},
    {{"Contact", "What counts as overlap."}},
    {{"Breakage", "Energy criterion of micro-breakage."}},
    {{"Membrane", "The finite-element membrane round the specimen."}, true},
    {{"Coupling",
      "How particles and membrane, subgrade or elastic plate exchange motion "
      "and loads."},
     true},
    {{"Time", "Time integration."}},
    {{"Run", "The machine."}}};

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
  std::vector<ListedSection> all = {{{"Case", "What is run."}, {}}};
  for (const TestKind &kind : test_kinds())
    for (const Section &section : kind.sections)
      all.push_back({section, {kind.name}});
  for (const CommonSection &common : common_sections)
    all.push_back({common.section, common.is_shared
                                       ? kinds_with(common.section.name)
                                       : std::vector<std::string>{}});
  for (const WallSection &wall : of.walls)
    all.push_back({{wall.section(), "Rigid wall " + wall.name +
                                        ": a mesh that is at rest or moves."},
                   kinds_with("Walls")});
  return all;
}

std::vector<Parameter> parameters_of(Case &of)
{
  List list;
  list.in("Case", after_preparation);
  list.add_name({"kind", "-", "Kind of test."}, of.kind, kind_names());
  list.add({"title", "-", "Heading of the report."}, of.title).may_change =
      true;
  for (const TestKind &kind : test_kinds())
  {
    list.only_of(kind.name);
    kind.add_parameters(list, of);
  }
  list.only_of("");
  // Its values are in their sections.
  list.in("Material", {.decides_preparation = false, .may_change = true});
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
  list.in("MembraneContact", after_preparation);
  add_wall(list, of.membrane_contact, between(0., 0.),
           "the membrane has no rotational unknowns to take the moment");
  add_contact(list, of);
  add_breakage(list, of.breakage);
  add_membrane(list, of.membrane);
  add_coupling(list, of.coupling);
  add_time(list, of.time);
  list.in("Run", {.decides_preparation = false, .may_change = true});
  list.add({"threads", "-",
            "Most OpenMP threads of the run, 0: all cores; the fastest number "
            "up to it is used."},
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
} // namespace spall
