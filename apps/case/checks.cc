#include "case/checks.h"

#include "case/fields.h"
#include "case/file.h"
#include "case/parameter.h"
#include "errors.h"

#include <dem/io/table_file.h>

#include <algorithm>
#include <filesystem>
#include <utility>

namespace spall
{
void refuse(const SourceLocation &location, const Fault &fault)
{
  throw InputError(location(fault.section, fault.key) + ": " + fault.section +
                   "/" + fault.key + " = " + fault.value + ": " +
                   fault.allowed);
}

Gradation check_gradation(const Case &c, const SourceLocation &location,
                          const std::string &section, const std::string &file)
{
  if (file.empty())
    refuse(location, {section, "gradation", "",
                      "must name a CSV file diameter_m,passing_1"});
  return read_gradation(find_path(c, section, "gradation", file));
}

void check_shapes(const Case &c, const SourceLocation &location,
                  const std::string &section, const std::string &shapes)
{
  if (!shapes.empty() &&
      !std::filesystem::is_directory(find_path(c, section, "shapes", shapes)))
    refuse(location, {section, "shapes", shapes,
                      "must be a folder of shape files, or empty for spheres"});
}

void check_every_step(const Case &c, const SourceLocation &location)
{
  const CouplingParameters &p = c.coupling;
  if (p.exchange != ExchangeChoice::every_step)
    return;
  if (p.rules.particle_steps != 1)
    refuse(location, {"Coupling", "particle_steps",
                      std::to_string(p.rules.particle_steps),
                      "must be 1 with Coupling/exchange = every_step"});
  if (p.body_steps != 1)
    refuse(location, {"Coupling", "body_steps", std::to_string(p.body_steps),
                      "must be 1 with Coupling/exchange = every_step"});
  if (p.is_body_implicit)
    refuse(location, {"Coupling", "body_time", "implicit",
                      "must be explicit with Coupling/exchange = every_step"});
}

void check_equal_windows(const Case &c, const SourceLocation &location)
{
  const double tolerance = c.coupling.rules.window_tolerance;
  if (tolerance > 0.)
    refuse(location, {"Coupling", "window_tolerance", number_text(tolerance),
                      "must be 0, except with Case/kind = subgrade, "
                      "Subgrade/body = full and Coupling/exchange = one_pass"});
}

void check_inertia(const Case &c, const SourceLocation &location)
{
  using enum dem::ContactGeometry;
  if (c.contact.wall_geometry == surface && c.contact.geometry != surface)
    refuse(location,
           {"Contact", "wall_geometry", "surface",
            "must be sphere or radial, unless Contact/geometry = surface "
            "too (particles turn with their inertia tensors then)"});
}

void check_no_step_error(const Case &c, const SourceLocation &location)
{
  if (c.time.step == StepRule::error)
    refuse(location, {"Time", "step", "error",
                      "must be fixed or stable for this kind of test"});
}

void check_membrane(const Case &c, const SourceLocation &location,
                    const std::string &choice)
{
  const CouplingParameters &p = c.coupling;
  if (p.exchange == ExchangeChoice::none)
    refuse(location,
           {"Coupling", "exchange", "none",
            "with " + choice +
                " must be one of every_step, one_pass, iterated; spall check "
                "compares them"});
  check_equal_windows(c, location);
  check_every_step(c, location);
  if (c.time.step == StepRule::error && p.rules.particle_steps != 1)
    refuse(location,
           {"Time", "step", "error",
            "must be fixed or stable with Coupling/particle_steps above "
            "1"});
  if (c.membrane.law == fem::MembraneLaw::neo_hooke &&
      c.membrane.poisson_ratio != 0.5)
    refuse(location,
           {"Membrane", "poisson_ratio", number_text(c.membrane.poisson_ratio),
            "must be 0.5 with Membrane/law = neo_hooke, which is "
            "incompressible"});
  if (c.membrane.wrinkling == fem::MembraneWrinkling::none &&
      c.membrane.residual_stiffness > 0.)
    refuse(location, {"Membrane", "residual_stiffness",
                      number_text(c.membrane.residual_stiffness),
                      "must be 0 unless Membrane/wrinkling = tension_field"});
}

void check_contact_tangent(const Case &c, const SourceLocation &location,
                           bool has_membrane)
{
  const CouplingParameters &p = c.coupling;
  if (!p.rules.has_contact_tangent)
    return;
  if (!has_membrane || p.exchange == ExchangeChoice::every_step ||
      !p.is_body_implicit || p.body_steps != 1)
    refuse(location, {"Coupling", "contact_tangent", "true",
                      "is for a membrane with Coupling/exchange = one_pass or "
                      "iterated, body_time = implicit and body_steps = 1"});
}

void check_at_rest(const Case &c, const SourceLocation &location,
                   const WallSection &wall, const std::string &allowed)
{
  const std::pair<const char *, bool> moving[] = {
      {"velocity", !wall.velocity.isZero()},
      {"amplitude", !wall.amplitude.isZero()},
      {"table", !wall.table.empty()},
      {"rotation_rate", wall.rotation_rate != 0.},
      {"free", wall.free != FreeDirections::none},
      {"inertia", wall.inertia > 0.}};
  Case any = c;
  for (const auto &[key, is_moving] : moving)
    for (const Parameter &parameter :
         is_moving ? parameters_of(any) : std::vector<Parameter>{})
      if (parameter.section == wall.section() && parameter.key == key)
        refuse(location, {wall.section(), key, value_text(parameter), allowed});
}

namespace
{
void check_breakage(const Case &c, const SourceLocation &location)
{
  const dem::BreakageParameters &b = c.breakage;
  if (2. * b.min_equivalent_radius > b.min_diameter)
    refuse(location, {"Breakage", "min_equivalent_radius",
                      number_text(b.min_equivalent_radius),
                      "must be at most half of Breakage/min_diameter = " +
                          number_text(b.min_diameter)});
}

/// True surfaces follow their contacts from touch on: nothing pulls before.
void check_attraction(const SourceLocation &location, const std::string &key,
                      const std::string &law, dem::ContactGeometry geometry)
{
  if (geometry == dem::ContactGeometry::surface &&
      dem::LawChoice{dem::contact_law_number(law), {}}.entry().attracts)
    refuse(location, {"Contact", key, "surface",
                      "must be sphere or radial with the law " + law +
                          ", which attracts across a gap"});
}

void check_attractions(const Case &c, const SourceLocation &location)
{
  check_attraction(location, "geometry", c.particle.law, c.contact.geometry);
  check_attraction(location, "wall_geometry", c.wall.law,
                   c.contact.wall_geometry);
}

void check_overlap(const Case &c, const SourceLocation &location)
{
  const dem::OverlapLimits &limits = c.contact.overlap;
  if (limits.warning > limits.stop)
    refuse(location, {"Contact", "overlap_warning", number_text(limits.warning),
                      "must be at most Contact/overlap_stop = " +
                          number_text(limits.stop)});
}

/// Along an axis a wall has either a prescribed motion or forces.
void check_drive(const SourceLocation &location, const WallSection &wall)
{
  const std::string section = wall.section();
  const dem::Vec3 is_free = free_axes(wall.free),
                  is_held = dem::Vec3::Ones() - is_free;
  const auto require_zero = [&](const char *key, const dem::Vec3 &value,
                                const dem::Vec3 &where,
                                const std::string &allowed)
  {
    if (!value.cwiseProduct(where).isZero(0.))
      refuse(location, {section, key, number_text(value), allowed});
  };
  const std::string of_forces = "must be 0 along axes that are not in " +
                                section +
                                "/free, where a force does not move the wall",
                    of_motions = "must be 0 along the axes in " + section +
                                 "/free, where forces move the wall instead";
  require_zero("force", wall.force, is_held, of_forces);
  require_zero("force_amplitude", wall.force_amplitude, is_held, of_forces);
  require_zero("velocity", wall.velocity, is_free, of_motions);
  require_zero("amplitude", wall.amplitude, is_free, of_motions);
  if (!wall.force_amplitude.isZero() && wall.frequency == 0.)
    refuse(location, {section, "frequency", "0",
                      "must be above 0 with " + section + "/force_amplitude"});
  if (wall.torque != 0. && wall.inertia == 0.)
    refuse(location, {section, "torque", number_text(wall.torque),
                      "must be 0 unless " + section + "/inertia is above 0"});
  if (wall.rotation_rate != 0. && wall.inertia > 0.)
    refuse(location, {section, "rotation_rate", number_text(wall.rotation_rate),
                      "must be 0 with " + section +
                          "/inertia, where torques rotate the "
                          "wall instead"});
}

void check_walls(const Case &c, const SourceLocation &location)
{
  for (const WallSection &wall : c.walls)
  {
    const std::string section = wall.section();
    if (wall.mesh.empty())
      refuse(location,
             {section, "mesh", "",
              "must name a mesh of triangles: STL, PLY, OBJ or gmsh"});
    if (dem::LawChoice{dem::contact_law_number(wall.material.law), {}}
            .entry()
            .attracts)
      refuse(location, {section, "law", wall.material.law,
                        "must be a law without attraction: a mesh does not "
                        "attract across gaps"});
    if (wall.axis.norm() < 1e-12)
      refuse(location, {section, "axis", "0, 0, 0", "must not be zero"});
    if (!wall.amplitude.isZero() && wall.frequency == 0.)
      refuse(location, {section, "frequency", "0",
                        "must be above 0 with " + section + "/amplitude"});
    check_drive(location, wall);
  }
}

void check_frame_tables(const Case &c, const SourceLocation &location)
{
  if (c.output.frame_tables == FrameTables::hdf5 && dem::hdf5_version().empty())
    refuse(location, {"Output", "frame_tables", "hdf5",
                      "must be none: this program is built without HDF5 "
                      "(CMake option SPALL_HDF5)"});
}
} // namespace

void check_case(const Case &parameters, const SourceLocation &location)
{
  check_frame_tables(parameters, location);
  check_breakage(parameters, location);
  check_attractions(parameters, location);
  check_overlap(parameters, location);
  check_walls(parameters, location);
  find_kind(parameters.kind)->check(parameters, location);
}
} // namespace spall
