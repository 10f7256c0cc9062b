// From the servo walls to what closes the specimen while it is loaded, and its
// rest there.
#include "case/parameter.h"
#include "errors.h"
#include "triaxial/triaxial.h"

#include <dem/engine_boundaries.h>
#include <dem/measure/assembly.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace spall
{
namespace
{
/// Interval of the checks for rest in the consolidation [steps].
constexpr std::int64_t rest_interval = 200;
} // namespace

void Triaxial::consolidate()
{
  // The first half hands over from the planes to the membrane, or from one
  // pressure to the other; the second half is rest.
  const double done =
      static_cast<double>(schedule.intervals()) + schedule.share_after_step();
  const double share =
      std::min(1., 2. * done / static_cast<double>(stage_intervals));
  const double from = parameters.preparation.pressure,
               to = parameters.loading.confining_pressure;
  const double isotropic = std::lerp(from, to, share);
  if (cell->has_membrane())
  {
    pressure = share * to;
    open_sides(share);
  }
  else
    for (int d = 0; d < 2; ++d)
      servo.follow(d, isotropic);
  cell->set_drive(-isotropic * area);
  follower.aim_at(isotropic);
  step_boundaries();
  if (schedule.intervals() < stage_intervals)
    return;
  const bool is_first =
      schedule.intervals() == stage_intervals && schedule.is_on_sample();
  if ((is_first || in_stage % rest_interval == 0) && is_consolidated())
    begin_loading();
  else if (consolidation.time > parameters.loading.consolidation_time +
                                    parameters.loading.consolidation_max_time)
    throw RunFailure(unconsolidated_text());
}

/// A load in balance may pass through a plate that swings: its motion would
/// change the load by sqrt(kinetic / elastic energy).
bool Triaxial::is_consolidated()
{
  engine().synchronize();
  const LoadingParameters &l = parameters.loading;
  const fem::RigidPlate &plate = cell->plate();
  consolidation.time = engine().time() - preparation.time;
  consolidation.load_error =
      std::abs(plate.resultant()) / (l.confining_pressure * area);
  consolidation.motion_error =
      std::sqrt(plate.kinetic_energy() /
                std::max(synchronized().energy().elastic, 1e-300));
  consolidation.unbalanced_ratio = dem::unbalanced_force_ratio(synchronized());
  if (!cell->has_membrane())
  {
    const dem::Vec3 stress = dem::box_stress(engine(), box);
    consolidation.side_error =
        (stress.head<2>().array() / l.confining_pressure - 1.).abs().maxCoeff();
  }
  const double error =
      std::max({consolidation.load_error, consolidation.motion_error,
                consolidation.side_error});
  return is_rough ||
         (error < l.consolidation_stress_tolerance &&
          consolidation.unbalanced_ratio < l.consolidation_unbalanced_ratio);
}

std::string Triaxial::unconsolidated_text() const
{
  const LoadingParameters &l = parameters.loading;
  std::ostringstream text;
  text.precision(3);
  text << "specimen is not at rest within Loading/consolidation_max_time = "
       << l.consolidation_max_time << " s: load on the plate off by "
       << consolidation.load_error << " and by its motion "
       << consolidation.motion_error << ", stress on rigid sides off by "
       << consolidation.side_error
       << " (Loading/consolidation_stress_tolerance = "
       << l.consolidation_stress_tolerance << "), unbalanced force ratio "
       << consolidation.unbalanced_ratio
       << " (Loading/consolidation_unbalanced_ratio = "
       << l.consolidation_unbalanced_ratio
       << (consolidation.side_error > 1.
               ? "): the servo sides oscillate: Boundary/servo_response_time "
                 "= " +
                     number_text(parameters.boundary.servo_response_time) +
                     " s must be longer"
               : "): allow more time or wider tolerances, or raise "
                 "Time/local_damping");
  return text.str();
}

void Triaxial::begin_loading()
{
  start_height = cell->plate().height() - lower.z();
  start_volume = volume();
  start_size = dem::box_size(engine(), box);
  engine().set_breaking(parameters.breakage.is_active);
  servo.follow_load();
  const auto walls_now = dem::mesh_walls(engine());
  for (std::size_t k = 0; k < walls_now.size(); ++k)
    walls_now[k].get().start_in(parameters.walls[k].start);
  watch.report(synchronized(), surroundings(), time_step());
  say(consolidated_text());
  begin_stage();
  enter(Stage::loading);
}

/// The rigid sides give way to the membrane, and are gone in the end.
void Triaxial::open_sides(double share)
{
  for (int d = 0; d < 2; ++d)
    if (share < 1.)
      servo.follow(d, (1. - share) * parameters.preparation.pressure);
    else
      servo.release(engine(), d);
  if (share < 1.)
    return;
  if (box.is_round())
    return put_side_away();
  for (std::size_t d = 0; d < 2; ++d)
    for (const std::size_t plane : box.planes[d])
      if (dem::planes(engine())[plane].is_active)
        dem::deactivate_plane(engine(), plane);
}

void Triaxial::put_side_away()
{
  dem::Drum side = dem::drum(engine());
  if (side.radius > upper.x() - lower.x())
    return; // it is
  side.radius *= 100.;
  dem::set_drum(engine(), side);
}
} // namespace spall
