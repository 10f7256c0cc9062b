#include "case/checks.h"

#include "case/file.h"
#include "case/list.h"
#include "case/notices.h"
#include "case/parameter.h"
#include "errors.h"
#include "specimen/container_mesh.h"
#include "subgrade/kind.h"
#include "subgrade/layer_room.h"
#include "subgrade/load.h"
#include "subgrade/scene.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace spall
{
namespace
{
/// Refuses with what `action` throws as the reason.
template <class Action>
void refuse_if_thrown(const SourceLocation &location, const Fault &fault,
                      const Action &action)
{
  try
  {
    action();
  }
  catch (const std::invalid_argument &what)
  {
    refuse(location, {fault.section, fault.key, fault.value, what.what()});
  }
  catch (const InputError &what) // of the file that the key names
  {
    refuse(location, {fault.section, fault.key, fault.value, what.what()});
  }
}

void check_layer(const Case &c, const SourceLocation &location,
                 const dem::Room &room)
{
  const LayerParameters &l = c.subgrade.layer;
  check_shapes(c, location, "Layer", l.shapes);
  const bool is_drawn = l.particles.empty();
  if (room.container)
    check_container(c, location, *room.container,
                    {"Layer", "thickness", is_drawn ? l.thickness : 0.});
  if (!is_drawn)
    return; // their number and sizes are those of the file
  if (l.initial_solid_fraction >= l.solid_fraction)
    refuse(location, {"Layer", "initial_solid_fraction",
                      number_text(l.initial_solid_fraction),
                      "must be below Layer/solid_fraction = " +
                          number_text(l.solid_fraction)});
  const Gradation curve = check_gradation(c, location, "Layer", l.gradation);
  const double largest = curve.diameter.back();
  const std::string particle =
      "the largest particle of the gradation, " + largest_text(curve);
  if (room.container)
    check_container_width(c, location, *room.container, curve,
                          {3., "three times"});
  else if (std::min(l.length, l.width) < 3. * largest)
    refuse(location, {"Layer", l.length < l.width ? "length" : "width",
                      number_text(std::min(l.length, l.width)),
                      "must be at least three times " + particle});
  if (l.thickness < largest)
    refuse(location, {"Layer", "thickness", number_text(l.thickness),
                      "must be at least " + particle});
}

void check_plate(const Case &c, const SourceLocation &location,
                 const dem::Room &room)
{
  const LoadPlateParameters &p = c.subgrade.plate;
  const LayerParameters &l = c.subgrade.layer;
  const Footprint half = footprint(p);
  const bool is_disc = p.form == PlateForm::disc;
  if (room.container)
  {
    if (!room.container->holds_column(column_below(p, 0., 1.).corners))
      refuse(location,
             {"LoadPlate", is_disc ? "diameter" : "length",
              number_text(2. * half.half_x),
              "the plate, with its middle on the z axis, must fit into "
              "Container/mesh at every height"});
    return;
  }
  if (2. * half.half_x > l.length)
    refuse(location,
           {"LoadPlate", is_disc ? "diameter" : "length",
            number_text(2. * half.half_x),
            "must be at most Layer/length = " + number_text(l.length)});
  if (2. * half.half_y > l.width)
    refuse(location, {"LoadPlate", is_disc ? "diameter" : "width",
                      number_text(2. * half.half_y),
                      "must be at most Layer/width = " + number_text(l.width)});
}

/// A ground without a mesh lies under all particles.
void check_extent(const Case &c, const SourceLocation &location,
                  const dem::Room &room)
{
  const GroundParameters &g = c.subgrade.ground;
  const double length[] = {g.length, g.width};
  const char *const keys[] = {"length", "width"};
  for (int d = 0; d < 2; ++d)
  {
    double reach = 0.;
    for (const Eigen::Vector2d &corner : foot_of(room))
      reach = std::max(reach, std::abs(corner[d]));
    if (length[d] >= (room.container ? 1. - 1e-9 : 1.) * 2. * reach)
      continue;
    const std::string what =
        room.container
            ? number_text(2. * reach) + ": Container/mesh stands up to " +
                  number_text(reach) + " m from the z axis along " + "xy"[d]
            : std::string("Layer/") + keys[d] + " = " + number_text(2. * reach);
    refuse(location, {"Subgrade", keys[d], number_text(length[d]),
                      "must be at least " + what});
  }
}

void check_block(const Case &c, const SourceLocation &location,
                 const dem::Room &room)
{
  check_extent(c, location, room);
  const GroundParameters &g = c.subgrade.ground;
  const Footprint half = footprint(c.subgrade.plate);
  const double narrow = 2. * std::min(half.half_x, half.half_y);
  if (g.cell_size > std::min(narrow, depth_of(g)))
    refuse(location, {"Subgrade", "cell_size", number_text(g.cell_size),
                      "must be at most the narrow side of the plate, " +
                          number_text(narrow) + " m, and the depth, " +
                          number_text(depth_of(g)) + " m"});
}

void check_ground(const Case &c, const SourceLocation &location,
                  const dem::Room &room)
{
  const GroundParameters &g = c.subgrade.ground;
  const RecordParameters &r = c.subgrade.record;
  refuse_if_thrown(location, {"Subgrade", "layers", g.layers, ""},
                   [&] { parse_ground_layers(g.layers); });
  refuse_if_thrown(location, {"Record", "stress_depths", r.stress_depths, ""},
                   [&] { parse_depths(r.stress_depths); });
  if (g.mesh.empty())
    check_block(c, location, room);
  else
    find_path(c, "Subgrade", "mesh", g.mesh);
  const std::vector<double> depths = parse_depths(r.stress_depths);
  if (!depths.empty() && depths.back() >= depth_of(g))
    refuse(location, {"Record", "stress_depths", r.stress_depths,
                      "must be less deep than the subgrade, " +
                          number_text(depth_of(g)) + " m"});
  if (g.body == GroundBody::condensed && !depths.empty())
    refuse(location,
           {"Record", "stress_depths", r.stress_depths,
            "must be empty with Subgrade/body = condensed, which has no "
            "inside"});
}

void check_solver(const Case &c, const SourceLocation &location)
{
  const GroundParameters &g = c.subgrade.ground;
  if (g.solver != GroundSolver::direct && g.body == GroundBody::condensed)
    refuse(location, {"Subgrade", "solver",
                      g.solver == GroundSolver::amg ? "amg" : "distributed_amg",
                      "must be direct with Subgrade/body = condensed, which is "
                      "made of factors"});
}

void check_yielding(const Case &c, const SourceLocation &location)
{
  const GroundParameters &g = c.subgrade.ground;
  if (g.body == GroundBody::condensed && yields(g))
    refuse(location,
           {"Subgrade", "body", "condensed",
            "must be full with Subgrade/layers that yield: a condensed "
            "body is elastic"});
}

void check_pulse(const Case &c, const SourceLocation &location)
{
  const PulseParameters &p = c.subgrade.pulse;
  const Fault table{"Pulse", "table", p.table, ""},
      shares{"Pulse", "share_table", p.share_table, ""};
  if (p.form == PulseForm::table && p.table.empty())
    refuse(location, {"Pulse", "table", "",
                      "must name a CSV file time_s,force_N with Pulse/form = "
                      "table"});
  if (p.form != PulseForm::train)
    return refuse_if_thrown(location, table, [&] { SubgradeLoad load(c); });
  if (p.share == AxleShareForm::table && p.share_table.empty())
    refuse(location,
           {"Pulse", "share_table", "",
            "must name a CSV file distance_m,share_1 with Pulse/share = "
            "table"});
  refuse_if_thrown(location,
                   {"Pulse", "axle_spacing", number_text(p.axle_spacing), ""},
                   [&] { fem::axle_distances(train_of(p)); });
  refuse_if_thrown(location, shares, [&] { SubgradeLoad load(c); });
}

void check_exchange(const Case &c, const SourceLocation &location)
{
  const CouplingParameters &p = c.coupling;
  const bool is_condensed = c.subgrade.ground.body == GroundBody::condensed;
  if (p.exchange == ExchangeChoice::none)
    refuse(location,
           {"Coupling", "exchange", "none",
            "must be one of every_step, one_pass, iterated; spall check "
            "compares them"});
  if (is_condensed || p.exchange != ExchangeChoice::one_pass)
    check_equal_windows(c, location);
  check_every_step(c, location);
  if (!is_condensed)
    return;
  if (p.exchange == ExchangeChoice::every_step)
    refuse(location, {"Coupling", "exchange", "every_step",
                      "must be one_pass or iterated with Subgrade/body = "
                      "condensed"});
  if (!p.is_body_implicit)
    refuse(location, {"Coupling", "body_time", "explicit",
                      "must be implicit with Subgrade/body = condensed"});
  if (c.time.step != StepRule::fixed)
    refuse(location, {"Time", "step", "stable",
                      "must be fixed with Subgrade/body = condensed"});
}

void check_rows(const Case &c, const SourceLocation &location)
{
  const double window = c.coupling.rules.particle_steps * c.time.fixed_step;
  const RecordParameters &r = c.subgrade.record;
  if (c.time.step == StepRule::fixed && r.row_interval < window)
    refuse(location, {"Record", "row_interval", number_text(r.row_interval),
                      "must be at least a window, Coupling/particle_steps "
                      "Time/fixed_step = " +
                          number_text(window) + " s"});
}
} // namespace

void check_subgrade(const Case &parameters, const SourceLocation &location)
{
  check_inertia(parameters, location);
  check_contact_tangent(parameters, location, false);
  const dem::Room room = layer_room(parameters);
  check_layer(parameters, location, room);
  check_plate(parameters, location, room);
  check_ground(parameters, location, room);
  check_solver(parameters, location);
  check_yielding(parameters, location);
  check_pulse(parameters, location);
  check_exchange(parameters, location);
  check_rows(parameters, location);
  check_no_step_error(parameters, location);
}

std::vector<std::string> subgrade_notices(const Case &c,
                                          const SetLocations &set)
{
  const auto location = set.find("Subgrade/layers");
  if (location == set.end())
    return {};
  std::vector<std::string> notices;
  int number = 0;
  for (const GroundLayer &layer : parse_ground_layers(c.subgrade.ground.layers))
  {
    ++number;
    const auto note = [&](const std::string &what, double value,
                          const Range &usual, const std::string &unit)
    {
      if (is_unusual(value, usual))
        notices.push_back(location->second + ": Subgrade/layers: " + what +
                          " of layer " + std::to_string(number) + " = " +
                          number_text(value) + ": " +
                          unusual_text(usual, unit));
    };
    note("thickness", layer.thickness, usual_lengths, "m");
    note("Young's modulus", layer.youngs_modulus, usual_moduli, "Pa");
    note("density", layer.density, usual_densities, "kg/m^3");
  }
  return notices;
}
} // namespace spall
