#include "case/checks.h"

#include "case/file.h"
#include "case/parameter.h"
#include "errors.h"

#include <algorithm>
#include <filesystem>

namespace spall
{
void refuse(const Place &place, const Fault &fault)
{
  throw InputError(place(fault.section, fault.key) + ": " + fault.section +
                   "/" + fault.key + " = " + fault.value + ": " +
                   fault.allowed);
}

Gradation check_gradation(const Case &c, const Place &place,
                          const std::string &section, const std::string &file)
{
  if (file.empty())
    refuse(place, {section, "gradation", "",
                   "must name a CSV file diameter_m,passing_1"});
  return read_gradation(find_path(c, section, "gradation", file));
}

void check_shapes(const Case &c, const Place &place, const std::string &section,
                  const std::string &shapes)
{
  if (!shapes.empty() &&
      !std::filesystem::is_directory(find_path(c, section, "shapes", shapes)))
    refuse(place, {section, "shapes", shapes,
                   "must be a folder of shape files, or empty for spheres"});
}

void check_every_step(const Case &c, const Place &place)
{
  const CouplingParameters &p = c.coupling;
  if (p.exchange != ExchangeChoice::every_step)
    return;
  if (p.rules.particle_steps != 1)
    refuse(place, {"Coupling", "particle_steps",
                   std::to_string(p.rules.particle_steps),
                   "must be 1 with Coupling/exchange = every_step"});
  if (p.body_steps != 1)
    refuse(place, {"Coupling", "body_steps", std::to_string(p.body_steps),
                   "must be 1 with Coupling/exchange = every_step"});
  if (p.is_body_implicit)
    refuse(place, {"Coupling", "body_time", "implicit",
                   "must be explicit with Coupling/exchange = every_step"});
}

void check_equal_windows(const Case &c, const Place &place)
{
  const double tolerance = c.coupling.rules.window_tolerance;
  if (tolerance > 0.)
    refuse(place, {"Coupling", "window_tolerance", number_text(tolerance),
                   "must be 0, except with Case/kind = subgrade, "
                   "Subgrade/body = full and Coupling/exchange = one_pass"});
}

void check_inertia(const Case &c, const Place &place)
{
  using enum dem::ContactGeometry;
  if (c.contact.wall_geometry == surface && c.contact.geometry != surface)
    refuse(place,
           {"Contact", "wall_geometry", "surface",
            "must be sphere or radial, unless Contact/geometry = surface "
            "too (particles turn with their inertia tensors then)"});
}

void check_no_step_error(const Case &c, const Place &place)
{
  if (c.time.step == StepRule::error)
    refuse(place, {"Time", "step", "error",
                   "must be fixed or stable for this kind of test"});
}

void check_membrane(const Case &c, const Place &place,
                    const std::string &choice)
{
  const CouplingParameters &p = c.coupling;
  if (p.exchange == ExchangeChoice::none)
    refuse(place,
           {"Coupling", "exchange", "none",
            "with " + choice +
                " must be one of every_step, one_pass, iterated; spall check "
                "compares them"});
  check_equal_windows(c, place);
  check_every_step(c, place);
  if (c.time.step == StepRule::error && p.rules.particle_steps != 1)
    refuse(place, {"Time", "step", "error",
                   "must be fixed or stable with Coupling/particle_steps above "
                   "1"});
  if (c.membrane.law == fem::MembraneLaw::neo_hooke &&
      c.membrane.poisson_ratio != 0.5)
    refuse(place,
           {"Membrane", "poisson_ratio", number_text(c.membrane.poisson_ratio),
            "must be 0.5 with Membrane/law = neo_hooke, which is "
            "incompressible"});
  if (c.membrane.wrinkling == fem::MembraneWrinkling::none &&
      c.membrane.residual_stiffness > 0.)
    refuse(place, {"Membrane", "residual_stiffness",
                   number_text(c.membrane.residual_stiffness),
                   "must be 0 unless Membrane/wrinkling = tension_field"});
}

void check_contact_tangent(const Case &c, const Place &place, bool has_membrane)
{
  const CouplingParameters &p = c.coupling;
  if (!p.rules.has_contact_tangent)
    return;
  if (!has_membrane || p.exchange == ExchangeChoice::every_step ||
      !p.is_body_implicit || p.body_steps != 1)
    refuse(place, {"Coupling", "contact_tangent", "true",
                   "is for a membrane with Coupling/exchange = one_pass or "
                   "iterated, body_time = implicit and body_steps = 1"});
}

namespace
{
void check_breakage(const Case &c, const Place &place)
{
  const dem::BreakageParameters &b = c.breakage;
  if (2. * b.min_equivalent_radius > b.min_diameter)
    refuse(place, {"Breakage", "min_equivalent_radius",
                   number_text(b.min_equivalent_radius),
                   "must be at most half of Breakage/min_diameter = " +
                       number_text(b.min_diameter)});
}

/// True surfaces follow their contacts from touch on: nothing pulls before.
void check_attraction(const Place &place, const std::string &key,
                      const std::string &law, dem::ContactGeometry geometry)
{
  if (geometry == dem::ContactGeometry::surface &&
      dem::LawChoice{dem::contact_law_number(law), {}}.entry().attracts)
    refuse(place, {"Contact", key, "surface",
                   "must be sphere or radial with the law " + law +
                       ", which attracts across a gap"});
}

void check_attractions(const Case &c, const Place &place)
{
  check_attraction(place, "geometry", c.particle.law, c.contact.geometry);
  check_attraction(place, "wall_geometry", c.wall.law, c.contact.wall_geometry);
}

void check_overlap(const Case &c, const Place &place)
{
  const dem::OverlapLimits &limits = c.contact.overlap;
  if (limits.warning > limits.stop)
    refuse(place, {"Contact", "overlap_warning", number_text(limits.warning),
                   "must be at most Contact/overlap_stop = " +
                       number_text(limits.stop)});
}

} // namespace

void check_case(const Case &parameters, const Place &place)
{
  check_breakage(parameters, place);
  check_attractions(parameters, place);
  check_overlap(parameters, place);
  find_kind(parameters.kind)->check(parameters, place);
}
} // namespace spall
