#include "case/checks.h"

#include "case/file.h"
#include "case/parameter.h"
#include "errors.h"
#include "subgrade/kind.h"
#include "subgrade/load.h"

#include <algorithm>
#include <stdexcept>

namespace spall
{
namespace
{
/// Refuses with what `action` throws as the reason.
template <class Action>
void refuse_if_thrown(const Place &place, const Fault &fault,
                      const Action &action)
{
  try
  {
    action();
  }
  catch (const std::invalid_argument &what)
  {
    refuse(place, {fault.section, fault.key, fault.value, what.what()});
  }
}

void check_layer(const Case &c, const Place &place)
{
  const LayerParameters &l = c.subgrade.layer;
  const Gradation curve = check_gradation(c, place, "Layer", l.gradation);
  check_shapes(c, place, "Layer", l.shapes);
  const double largest = curve.diameter.back();
  const std::string particle =
      "the largest particle of the gradation, " + largest_text(curve);
  if (std::min(l.length, l.width) < 3. * largest)
    refuse(place, {"Layer", l.length < l.width ? "length" : "width",
                   number_text(std::min(l.length, l.width)),
                   "must be at least three times " + particle});
  if (l.thickness < largest)
    refuse(place, {"Layer", "thickness", number_text(l.thickness),
                   "must be at least " + particle});
  if (l.initial_solid_fraction >= l.solid_fraction)
    refuse(place, {"Layer", "initial_solid_fraction",
                   number_text(l.initial_solid_fraction),
                   "must be below Layer/solid_fraction = " +
                       number_text(l.solid_fraction)});
}

void check_plate(const Case &c, const Place &place)
{
  const LoadPlateParameters &p = c.subgrade.plate;
  const LayerParameters &l = c.subgrade.layer;
  const Footprint half = footprint(p);
  const bool is_disc = p.form == PlateForm::disc;
  if (2. * half.half_x > l.length)
    refuse(place, {"LoadPlate", is_disc ? "diameter" : "length",
                   number_text(2. * half.half_x),
                   "must be at most Layer/length = " + number_text(l.length)});
  if (2. * half.half_y > l.width)
    refuse(place, {"LoadPlate", is_disc ? "diameter" : "width",
                   number_text(2. * half.half_y),
                   "must be at most Layer/width = " + number_text(l.width)});
}

/// Of a ground without a mesh.
void check_block(const Case &c, const Place &place)
{
  const GroundParameters &g = c.subgrade.ground;
  const LayerParameters &l = c.subgrade.layer;
  if (g.length < l.length)
    refuse(place, {"Subgrade", "length", number_text(g.length),
                   "must be at least Layer/length = " + number_text(l.length)});
  if (g.width < l.width)
    refuse(place, {"Subgrade", "width", number_text(g.width),
                   "must be at least Layer/width = " + number_text(l.width)});
  const Footprint half = footprint(c.subgrade.plate);
  const double narrow = 2. * std::min(half.half_x, half.half_y);
  if (g.cell_size > std::min(narrow, depth_of(g)))
    refuse(place, {"Subgrade", "cell_size", number_text(g.cell_size),
                   "must be at most the narrow side of the plate, " +
                       number_text(narrow) + " m, and the depth, " +
                       number_text(depth_of(g)) + " m"});
}

void check_ground(const Case &c, const Place &place)
{
  const GroundParameters &g = c.subgrade.ground;
  const RecordParameters &r = c.subgrade.record;
  refuse_if_thrown(place, {"Subgrade", "layers", g.layers, ""},
                   [&] { parse_ground_layers(g.layers); });
  refuse_if_thrown(place, {"Record", "stress_depths", r.stress_depths, ""},
                   [&] { parse_depths(r.stress_depths); });
  if (g.mesh.empty())
    check_block(c, place);
  else
    find_path(c, "Subgrade", "mesh", g.mesh);
  const std::vector<double> depths = parse_depths(r.stress_depths);
  if (!depths.empty() && depths.back() >= depth_of(g))
    refuse(place, {"Record", "stress_depths", r.stress_depths,
                   "must be less deep than the subgrade, " +
                       number_text(depth_of(g)) + " m"});
  if (g.body == GroundBody::condensed && !depths.empty())
    refuse(place, {"Record", "stress_depths", r.stress_depths,
                   "must be empty with Subgrade/body = condensed, which has no "
                   "inside"});
}

void check_solver(const Case &c, const Place &place)
{
  const GroundParameters &g = c.subgrade.ground;
  if (g.solver == GroundSolver::amg && g.body == GroundBody::condensed)
    refuse(place, {"Subgrade", "solver", "amg",
                   "must be direct with Subgrade/body = condensed, which is "
                   "made of factors"});
}

void check_yielding(const Case &c, const Place &place)
{
  const GroundParameters &g = c.subgrade.ground;
  if (g.body == GroundBody::condensed && yields(g))
    refuse(place, {"Subgrade", "body", "condensed",
                   "must be full with Subgrade/layers that yield: a condensed "
                   "body is elastic"});
}

void check_pulse(const Case &c, const Place &place)
{
  const PulseParameters &p = c.subgrade.pulse;
  const Fault table{"Pulse", "table", p.table, ""},
      shares{"Pulse", "share_table", p.share_table, ""};
  if (p.form == PulseForm::table && p.table.empty())
    refuse(place, {"Pulse", "table", "",
                   "must name a CSV file time_s,force_N with Pulse/form = "
                   "table"});
  if (p.form != PulseForm::train)
    return refuse_if_thrown(place, table, [&] { SubgradeLoad load(c); });
  if (p.share == AxleShareForm::table && p.share_table.empty())
    refuse(place, {"Pulse", "share_table", "",
                   "must name a CSV file distance_m,share_1 with Pulse/share = "
                   "table"});
  refuse_if_thrown(place,
                   {"Pulse", "axle_spacing", number_text(p.axle_spacing), ""},
                   [&] { fem::axle_distances(train_of(p)); });
  refuse_if_thrown(place, shares, [&] { SubgradeLoad load(c); });
}

void check_exchange(const Case &c, const Place &place)
{
  const CouplingParameters &p = c.coupling;
  const bool is_condensed = c.subgrade.ground.body == GroundBody::condensed;
  if (p.exchange == ExchangeChoice::none)
    refuse(place, {"Coupling", "exchange", "none",
                   "must be one of every_step, one_pass, iterated; spall check "
                   "compares them"});
  if (is_condensed || p.exchange != ExchangeChoice::one_pass)
    check_equal_windows(c, place);
  check_every_step(c, place);
  if (!is_condensed)
    return;
  if (p.exchange == ExchangeChoice::every_step)
    refuse(place, {"Coupling", "exchange", "every_step",
                   "must be one_pass or iterated with Subgrade/body = "
                   "condensed"});
  if (!p.is_body_implicit)
    refuse(place, {"Coupling", "body_time", "explicit",
                   "must be implicit with Subgrade/body = condensed"});
  if (c.time.step != StepRule::fixed)
    refuse(place, {"Time", "step", "stable",
                   "must be fixed with Subgrade/body = condensed"});
}

void check_rows(const Case &c, const Place &place)
{
  const double window = c.coupling.rules.particle_steps * c.time.fixed_step;
  const RecordParameters &r = c.subgrade.record;
  if (c.time.step == StepRule::fixed && r.row_interval < window)
    refuse(place, {"Record", "row_interval", number_text(r.row_interval),
                   "must be at least a window, Coupling/particle_steps "
                   "Time/fixed_step = " +
                       number_text(window) + " s"});
}
} // namespace

void check_subgrade(const Case &parameters, const Place &place)
{
  check_inertia(parameters, place);
  check_contact_tangent(parameters, place, false);
  check_layer(parameters, place);
  check_plate(parameters, place);
  check_ground(parameters, place);
  check_solver(parameters, place);
  check_yielding(parameters, place);
  check_pulse(parameters, place);
  check_exchange(parameters, place);
  check_rows(parameters, place);
  check_no_step_error(parameters, place);
}
} // namespace spall
