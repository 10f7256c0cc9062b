#include "case/list.h"

namespace spall
{
void add_membrane(List &list, fem::MembraneParameters &m)
{
  list.in("Membrane", after_preparation);
  list.add(
      {"law", "-",
       "Material law of the membrane. The value st_venant_kirchhoff holds for "
       "stretches of some tens of per cent. The value neo_hooke is "
       "incompressible and holds for any stretch, with poisson_ratio 0.5."},
      m.law, {"st_venant_kirchhoff", "neo_hooke"});
  list.add({"youngs_modulus", "Pa", "Young's modulus E of the membrane."},
           m.youngs_modulus, above(0., 1e13), usual_moduli);
  list.add({"poisson_ratio", "-", "Poisson's ratio nu of the membrane."},
           m.poisson_ratio, between(0., 0.5));
  list.add({"thickness", "m", "Thickness of the undeformed membrane."},
           m.thickness, above(0., 0.1));
  list.add({"tension", "N/m",
            "Initial tension of the membrane, equal in all directions of its "
            "surface."},
           m.tension, between(0., 1e7));
  list.add({"wrinkling", "-",
            "Behaviour of the membrane under compression. With none it carries "
            "compression as it carries tension. With tension_field it wrinkles "
            "instead."},
           m.wrinkling, {"none", "tension_field"});
  list.add({"residual_stiffness", "-",
            "Share of the compression that a wrinkled membrane (tension_field) "
            "still carries."},
           m.residual_stiffness, below(0., 1.));
  list.add({"density", "kg/m^3", "Mass density of the undeformed membrane."},
           m.density, above(0., 3e4), usual_densities);
  list.add({"mass_damping", "1/s",
            "Mass-proportional damping coefficient alpha of the membrane. A "
            "force -alpha m v acts on each node."},
           m.mass_damping, between(0., 1e5));
}

namespace
{
void add_relaxation(List &list, coupling::ExchangeParameters &rules)
{
  list.add({"relaxation", "-",
            "Relaxation of the iterated exchange. The value constant uses the "
            "same factor in every pass. The value aitken computes it from the "
            "last two residuals."},
           rules.relaxation.kind, {"constant", "aitken"});
  list.add(
      {"relaxation_factor", "-",
       "Relaxation factor of the iterated exchange: share of a residual that a "
       "pass corrects. With aitken it is the factor of the first pass."},
      rules.relaxation.factor, above(0., 1.));
  list.add({"tolerance", "m",
            "Tolerance of the iterated exchange: gap that may remain between "
            "the body and its position as used by the particles."},
           rules.tolerance, above(0., 1e-3));
  list.add({"max_passes", "-",
            "Largest number of passes of the iterated exchange in one window. "
            "The result of the last pass is accepted."},
           rules.max_passes, between(1, 1e4));
  list.add({"gap_limit", "m",
            "Largest gap that the last pass of the iterated exchange may "
            "leave. The run stops at a larger gap."},
           rules.gap_limit, above(0., 1.))
      .may_change = true;
}
} // namespace

void add_coupling(List &list, CouplingParameters &c)
{
  list.in("Coupling", after_preparation);
  list.add({"exchange", "-",
            "Exchange between the particles and a deformable body: membrane, "
            "subgrade or elastic plate. With every_step both take the same "
            "explicit steps. With one_pass each window is computed once, with "
            "the body predicted from the last loads. With iterated each window "
            "is repeated until motion and loads agree. The value none is for "
            "cases without such a body. Templates set every_step for a "
            "membrane and one_pass for a subgrade."},
           c.exchange, {"none", "every_step", "one_pass", "iterated"});
  list.add({"particle_steps",
            "-",
            "Number of particle steps in one window. With window_tolerance it "
            "is the largest number.",
            "",
            {"stone_steps"}},
           c.rules.particle_steps, between(1, 1e4));
  list.add(
      {"window_tolerance", "-",
       "Tolerance of the window length for one_pass on a full subgrade. "
       "Windows are as long as the gain of the contacts allows. They are "
       "shorter where the interface energy error exceeds this share of the "
       "work across the interface. The value 0 gives windows of one length."},
      c.rules.window_tolerance, below(0., 1.));
  list.add({"body_time", "-",
            "Time integration of the deformable body: explicit or implicit."},
           c.is_body_implicit, {"explicit", "implicit"});
  list.add({"body_steps", "-",
            "Number of steps of the deformable body in one window."},
           c.body_steps, between(1, 1e4));
  list.add({"contact_tangent", "-",
            "Switch for the contact stiffness in the implicit steps of a "
            "membrane. With true, passes converge at any gain. One pass "
            "suffices while the contacts do not change."},
           c.rules.has_contact_tangent);
  add_relaxation(list, c.rules);
  list.add({"ledger_limit", "-",
            "Limit of the interface energy error, as a share of the work "
            "across the interface. The run stops above it."},
           c.ledger_limit, above(0., 1e6))
      .may_change = true;
}

coupling::ExchangeParameters
CouplingParameters::exchange_rules(Lateral lateral) const
{
  if (lateral != Lateral::membrane) // the plate alone
    return {};
  return exchange_rules();
}

coupling::ExchangeParameters CouplingParameters::exchange_rules() const
{
  coupling::ExchangeParameters all = rules;
  all.ledger_limit = ledger_limit;
  all.rule = exchange == ExchangeChoice::one_pass
                 ? coupling::ExchangeRule::one_pass
             : exchange == ExchangeChoice::iterated
                 ? coupling::ExchangeRule::iterated
                 : coupling::ExchangeRule::every_step;
  return all;
}
} // namespace spall
