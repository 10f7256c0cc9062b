#include "case/list.h"

namespace spall
{
void add_membrane(List &list, fem::MembraneParameters &m)
{
  list.in("Membrane", after_preparation);
  list.add({"law", "-",
            "st_venant_kirchhoff: stretches of some tens of per cent; "
            "neo_hooke: incompressible, any stretch, with poisson_ratio 0.5."},
           m.law, {"st_venant_kirchhoff", "neo_hooke"});
  list.add({"youngs_modulus", "Pa", "E."}, m.youngs_modulus, above(0., 1e13));
  list.add({"poisson_ratio", "-", "nu."}, m.poisson_ratio, between(0., 0.5));
  list.add({"thickness", "m", "Undeformed."}, m.thickness, above(0., 0.1));
  list.add({"tension", "N/m",
            "In the surface as it is built, the same in all directions."},
           m.tension, between(0., 1e7));
  list.add({"wrinkling", "-",
            "none: it bears compression as it bears tension; tension_field: it "
            "wrinkles instead."},
           m.wrinkling, {"none", "tension_field"});
  list.add({"residual_stiffness", "-",
            "tension_field: share of the compression of the law that is borne "
            "all the same."},
           m.residual_stiffness, below(0., 1.));
  list.add({"density", "kg/m^3", "Undeformed."}, m.density, above(0., 3e4));
  list.add({"mass_damping", "1/s", "alpha: force -alpha m v on each node."},
           m.mass_damping, between(0., 1e5));
}

namespace
{
void add_relaxation(List &list, coupling::ExchangeParameters &rules)
{
  list.add({"relaxation", "-",
            "iterated: constant, the same factor in every pass; aitken, from "
            "the last two residuals."},
           rules.relaxation.kind, {"constant", "aitken"});
  list.add({"relaxation_factor", "-",
            "iterated: share of a residual that a pass corrects; with aitken "
            "of the first."},
           rules.relaxation.factor, above(0., 1.));
  list.add(
      {"tolerance", "m",
       "iterated: gap left between the body and what particles saw of it."},
      rules.tolerance, above(0., 1e-3));
  list.add(
      {"max_passes", "-", "iterated: of one window; then the last counts."},
      rules.max_passes, between(1, 1e4));
  list.add({"gap_limit", "m",
            "iterated: the run stops if the last pass leaves a larger gap."},
           rules.gap_limit, above(0., 1.))
      .may_change = true;
}
} // namespace

void add_coupling(List &list, CouplingParameters &c)
{
  list.in("Coupling", after_preparation);
  list.add(
      {"exchange", "-",
       "every_step: particles and body (membrane, subgrade, elastic plate) "
       "take "
       "the same explicit steps; one_pass: window by window, the body "
       "predicted with the last loads; iterated: until motion and loads of "
       "each window agree; none: there is no such body (with one it is "
       "refused; templates write every_step for a membrane, one_pass for a "
       "subgrade)."},
      c.exchange, {"none", "every_step", "one_pass", "iterated"});
  list.add({"particle_steps",
            "-",
            "Steps of the particles in one window; at most, with "
            "window_tolerance.",
            "",
            {"stone_steps"}},
           c.rules.particle_steps, between(1, 1e4));
  list.add({"window_tolerance", "-",
            "one_pass on a full subgrade: windows are as long as the gain of "
            "the contacts allows, and shorter where the interface energy error "
            "exceeds this share of "
            "the work that crosses the interface; 0: all are of "
            "one length."},
           c.rules.window_tolerance, below(0., 1.));
  list.add({"body_time", "-", "How the body takes its steps."},
           c.is_body_implicit, {"explicit", "implicit"});
  list.add({"body_steps", "-", "Steps of the body in one window."},
           c.body_steps, between(1, 1e4));
  list.add({"contact_tangent", "-",
            "The stiffness of contacts enters the implicit steps of a "
            "membrane: passes contract at any gain, one is enough where "
            "contacts stay as they are."},
           c.rules.has_contact_tangent);
  add_relaxation(list, c.rules);
  list.add({"ledger_limit", "-",
            "The run stops where the interface energy error exceeds this share "
            "of the work that crosses the interface."},
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
