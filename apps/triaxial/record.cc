// What a triaxial test writes, and when.
#include "test/slices.h"
#include "triaxial/triaxial.h"

#include <dem/engine_boundaries.h>

#include <algorithm>
#include <cmath>

namespace spall
{
namespace
{
constexpr std::int64_t preparation_interval = 1000; // steps between rows

std::vector<Quantity> quantities_of(const Sample &sample,
                                    const std::vector<Quantity> &more)
{
  std::vector<Quantity> row;
  for (const SampleColumn &column : sample_columns)
    row.push_back({column.name, sample.*column.value});
  row.insert(row.end(), more.begin(), more.end());
  return row;
}
} // namespace

/// After a step. Rows, frames and checkpoints of the loading come at the
/// ends of sampling intervals.
void Triaxial::note_due()
{
  due_now = {};
  if (now < Stage::loading)
  {
    due_now.row = in_stage % preparation_interval == 0;
    return;
  }
  if (!schedule.is_on_sample())
    return;
  const OutputParameters &output = parameters.output;
  const std::int64_t n = cycle_intervals, interval = schedule.intervals();
  due_now.row = interval == 0 || follower.is_over() ||
                is_interval_due(output.samples_per_cycle);
  due_now.frame = interval == 0 || is_interval_due(output.frames_per_cycle);
  if (interval % n != 0 && !follower.is_over())
  {
    const double peak = follower.stage().wave.peak() * static_cast<double>(n);
    if (interval % n == static_cast<std::int64_t>(std::ceil(peak)))
    {
      engine().synchronize();
      cycles.take_peak(*this);
    }
    return;
  }
  // Jumps may pass the cycle that a checkpoint is due at.
  const std::int64_t cycle_now = std::llround(cycle()),
                     every = output.checkpoint_every;
  if (every == 0 || cycle_now / every == recorded.checkpoint_cycle / every)
    return;
  due_now.checkpoint = true;
  recorded.checkpoint_cycle = cycle_now;
}

std::vector<Quantity> Triaxial::row() const
{
  return quantities_of(sample(recorded.roundness), boundary_row());
}

std::vector<NamedBoundary> Triaxial::named_boundaries() const
{
  std::vector<NamedBoundary> all;
  const bool has_sides =
      !box.is_round() && parameters.boundary.lateral != Lateral::periodic;
  for (std::size_t d = 0; d < (has_sides ? 2u : 0u); ++d)
    for (std::size_t end = 0; end < 2; ++end)
      all.push_back({std::string(1, "xy"[d]) + (end == 0 ? "_min" : "_max"),
                     BoundaryKind::plane, box.planes[d][end]});
  all.push_back({"base", BoundaryKind::plane, box.planes[2][0]});
  all.push_back({"plate", BoundaryKind::plane, box.planes[2][1]});
  if (box.is_round())
    all.push_back({"side", BoundaryKind::drum});
  if (parameters.boundary.lateral == Lateral::membrane)
    all.push_back({"membrane", BoundaryKind::surface});
  return all;
}

dem::Vec3 Triaxial::moment_point() const
{
  const auto [low, high] = dem::box_corners(engine(), box);
  return {0.5 * (low.x() + high.x()), 0.5 * (low.y() + high.y()), low.z()};
}

std::vector<Quantity> Triaxial::take_row()
{
  const bool is_loading = now >= Stage::loading;
  if (recorded.roundness == 0. ||
      (is_loading &&
       (schedule.intervals() % cycle_intervals == 0 || follower.is_over())))
    recorded.roundness =
        known_roundness.mean(synchronized().particles(), ranks());
  recorded.last = sample(recorded.roundness);
  if (membrane())
    recorded.worst_gain = std::max(recorded.worst_gain, exchange_gain());
  if (is_loading)
  {
    recorded.peak_axial_stress =
        std::max(recorded.peak_axial_stress, recorded.last.axial_stress);
    recorded.strength.take(recorded.last);
    if (is_at_start())
      begin_record();
    cycles.take(*this, recorded.last);
  }
  return quantities_of(recorded.last, boundary_row());
}

void Triaxial::Strength::take(const Sample &row)
{
  const double axial = row.axial_stress, lateral = row.lateral_stress,
               q = axial - lateral, p = (axial + 2. * lateral) / 3.;
  if (q > deviator)
  {
    deviator = q;
    strain = row.axial_strain;
  }
  if (p <= 0. || axial + lateral <= 0.)
    return; // the specimen bears nothing
  stress_ratio = std::max(stress_ratio, q / p);
  friction_angle = std::max(
      friction_angle, std::asin(std::clamp(q / (axial + lateral), -1., 1.)));
}

/// The row where loading begins.
void Triaxial::begin_record()
{
  recorded.loading_start = recorded.last;
  recorded.plate_stress = (top_plane().force.z() + cell->rim_reaction()) / area;
  std::vector<std::string> warned;
  add_balance_warning(warned);
  for (const std::string &warning : warned)
    say("warning: " + warning);
}

std::vector<Quantity> Triaxial::own_ledger() const
{
  const double plate_work = cell ? cell->plate().drive_work() : 0.;
  return {{"membrane_work_J", synchronized().energy().work_of("facets")},
          {"plate_work_J", plate_work},
          {"energy_residual_J", recorded.last.energy_residual}};
}

FrameParts Triaxial::frame_parts() const
{
  const bool is_at_an_end =
      now >= Stage::loading && (is_at_start() || is_complete());
  const SurfaceFrames asked = parameters.output.surfaces;
  return {membrane(), asked == SurfaceFrames::all ||
                          (asked == SurfaceFrames::ends && is_at_an_end)};
}

std::optional<SliceSpace> Triaxial::slice_space() const
{
  if (now < Stage::loading)
    return {};
  const dem::Prism space = coupling::space_of(enclosed(engine()));
  return SliceSpace{
      space.low, space.high, [this, corners = space.corners](double z) {
        return membrane() ? tube_section(dem::surface(engine()), z) : corners;
      }};
}

EnergyBalance Triaxial::energy_balance() const
{
  Sample energies;
  add_energies(energies);
  return {energies.external_work, energies.energy_residual,
          energies.non_conservative_work};
}

EnergyBalance Triaxial::reported_balance() const
{
  return loading_balance(recorded.loading_start, recorded.last);
}

void Triaxial::add_clocks(std::map<std::string, double> &seconds) const
{
  Test::add_clocks(seconds);
  seconds["step_probe"] = probing;
}
} // namespace spall
