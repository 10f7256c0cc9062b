#include "case/checks.h"

#include "case/file.h"
#include "case/parameter.h"
#include "errors.h"
#include "subgrade/checks.h"

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
  const bool may_adapt = c.kind == CaseKind::subgrade &&
                         p.exchange == ExchangeChoice::one_pass &&
                         c.subgrade.ground.body == GroundBody::full;
  if (p.rules.window_tolerance > 0. && !may_adapt)
    refuse(place, {"Coupling", "window_tolerance",
                   number_text(p.rules.window_tolerance),
                   "must be 0, except with Case/kind = subgrade, "
                   "Subgrade/body = full and Coupling/exchange = one_pass"});
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

namespace
{
void check_specimen(const Case &c, const Place &place)
{
  const SpecimenParameters &s = c.specimen;
  if (s.initial_solid_fraction >= s.solid_fraction)
    refuse(place, {"Specimen", "initial_solid_fraction",
                   number_text(s.initial_solid_fraction),
                   "must be below Specimen/solid_fraction = " +
                       number_text(s.solid_fraction)});
  const Gradation curve = check_gradation(c, place, "Specimen", s.gradation);
  const double largest = curve.diameter.back();
  const auto check_size = [&](const std::string &key, double size)
  {
    if (size < 2. * largest)
      refuse(place, {"Specimen", key, number_text(size),
                     "must be at least twice the largest particle of the "
                     "gradation, " +
                         largest_text(curve)});
  };
  if (s.form == SpecimenForm::box)
    check_size("side", s.side);
  else
  {
    check_size("diameter", s.diameter);
    check_size("height", s.height);
  }
  check_shapes(c, place, "Specimen", s.shapes);
}

void check_breakage(const Case &c, const Place &place)
{
  const dem::BreakageParameters &b = c.breakage;
  if (2. * b.min_equivalent_radius > b.min_diameter)
    refuse(place, {"Breakage", "min_equivalent_radius",
                   number_text(b.min_equivalent_radius),
                   "must be at most half of Breakage/min_diameter = " +
                       number_text(b.min_diameter)});
}

/// Where particles meet each other, they turn with one inertia: that of
/// spheres, or their own.
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

void check_geometry(const Case &c, const Place &place)
{
  using enum dem::ContactGeometry;
  if (c.kind != CaseKind::single_particle &&
      c.contact.wall_geometry == surface && c.contact.geometry != surface)
    refuse(place,
           {"Contact", "wall_geometry", "surface",
            "must be sphere or radial, unless Contact/geometry = surface "
            "too (particles turn with their inertia tensors then)"});
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

void check_cycle_jump(const Case &c, const Place &place)
{
  if (c.cycle_jump.is_on() && c.loading.form == LoadForm::compression)
    refuse(place,
           {"CycleJump", "tolerance", number_text(c.cycle_jump.tolerance),
            "must be 0 with Loading/form = compression, which has no "
            "cycles"});
}

void check_time(const Case &c, const Place &place)
{
  const double sample = c.loading.period() / c.output.samples_per_cycle;
  const int n = c.coupling.exchange_rules(c.boundary.lateral).particle_steps;
  if (c.time.step == StepRule::fixed && n * c.time.fixed_step > sample)
    refuse(place, {"Time", "fixed_step", number_text(c.time.fixed_step),
                   "a window of " + std::to_string(n) +
                       " must be at most one sample of history.csv, " +
                       number_text(sample) +
                       " s (the period of Loading over "
                       "Output/samples_per_cycle)"});
  if (c.output.frames_per_cycle > c.output.samples_per_cycle)
    refuse(place, {"Output", "frames_per_cycle",
                   std::to_string(c.output.frames_per_cycle),
                   "must be at most Output/samples_per_cycle = " +
                       std::to_string(c.output.samples_per_cycle)});
}

/// What a window is must be said, and must make sense.
void check_coupling(const Case &c, const Place &place)
{
  const CouplingParameters &p = c.coupling;
  if (c.lateral() == Lateral::rigid)
    return;
  if (p.exchange == ExchangeChoice::none)
    refuse(place,
           {"Coupling", "exchange", "none",
            std::string("with ") +
                (c.kind == CaseKind::vibratory_compaction
                     ? "Container/form = flexible"
                     : "Boundary/lateral = membrane") +
                " must be one of every_step, one_pass, iterated; spall check "
                "compares them"});
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

/// A triaxial test between rigid sides does not read it.
void check_contact_tangent(const Case &c, const Place &place)
{
  const CouplingParameters &p = c.coupling;
  const bool is_rigid = c.lateral() == Lateral::rigid;
  if (!p.rules.has_contact_tangent ||
      (is_rigid && c.kind == CaseKind::dynamic_triaxial))
    return;
  if (is_rigid || c.kind == CaseKind::subgrade ||
      p.exchange == ExchangeChoice::every_step || !p.is_body_implicit ||
      p.body_steps != 1)
    refuse(place, {"Coupling", "contact_tangent", "true",
                   "is for a membrane with Coupling/exchange = one_pass or "
                   "iterated, body_time = implicit and body_steps = 1"});
}

void check_particle(const Case &c, const Place &place)
{
  const SingleParticleParameters &p = c.single_particle;
  if (!p.shape.empty())
    find_path(c, "Particle", "shape", p.shape);
  if (p.seed == 0 && p.axis_x == 0. && p.axis_y == 0. && p.axis_z == 0.)
    refuse(place, {"Particle", "axis_z", "0",
                   "must not be zero along with axis_x and axis_y"});
  if (c.press.displacement >= p.diameter)
    refuse(place,
           {"Press", "displacement", number_text(c.press.displacement),
            "must be below Particle/diameter = " + number_text(p.diameter)});
}

void check_drum(const Case &c, const Place &place)
{
  const Gradation curve =
      check_gradation(c, place, "Charge", c.charge.gradation);
  check_shapes(c, place, "Charge", c.charge.shapes);
  if (c.wall.rolling_friction > 0.)
    refuse(place,
           {"Wall", "rolling_friction", number_text(c.wall.rolling_friction),
            "must be 0: the rolling law takes walls not to turn"});
  const DrumParameters &d = c.drum;
  if (d.lifter_height > 0.29 * d.radius)
    refuse(place, {"Drum", "lifter_height", number_text(d.lifter_height),
                   "must be at most 0.29 Drum/radius = " +
                       number_text(0.29 * d.radius) +
                       " (the charge is put between the lifter and the axis)"});
  if (std::min(2. * d.radius, d.length) < 4. * curve.diameter.back())
    refuse(place, {"Drum", "radius", number_text(d.radius),
                   "the drum must be four times as wide and long as the "
                   "largest particle of the gradation, " +
                       largest_text(curve)});
}

void check_lab_time(const Case &c, const Place &place)
{
  if (c.time.step == StepRule::error)
    refuse(place, {"Time", "step", "error",
                   "must be fixed or stable for this kind of test"});
}
} // namespace

void check_case(const Case &parameters, const Place &place)
{
  check_breakage(parameters, place);
  check_geometry(parameters, place);
  check_overlap(parameters, place);
  check_contact_tangent(parameters, place);
  switch (parameters.kind)
  {
  case CaseKind::dynamic_triaxial:
    check_specimen(parameters, place);
    check_coupling(parameters, place);
    check_cycle_jump(parameters, place);
    return check_time(parameters, place);
  case CaseKind::single_particle:
    check_particle(parameters, place);
    return check_lab_time(parameters, place);
  case CaseKind::los_angeles:
    check_drum(parameters, place);
    return check_lab_time(parameters, place);
  case CaseKind::vibratory_compaction:
    check_compaction(parameters, place);
    check_coupling(parameters, place);
    return check_lab_time(parameters, place);
  case CaseKind::subgrade:
    check_subgrade(parameters, place);
    return check_lab_time(parameters, place);
  }
}
} // namespace spall
