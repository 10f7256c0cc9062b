// Rest of plate and particles before the vibration.
#include "case/parameter.h"
#include "compaction/compaction.h"
#include "errors.h"

#include <dem/measure/assembly.h>

#include <algorithm>
#include <cmath>

namespace spall
{
/// The least seating time, and then until plate and particles are at rest.
void Compaction::wait_for_rest()
{
  constexpr std::int64_t rest_interval = 100; // windows
  const double spent = engine().time() - now.release_time;
  if (spent < parameters.plate.seating_time)
    return;
  const bool is_asked = joined->n_windows() % rest_interval == 0;
  if (is_asked && is_seated())
    start_vibration();
  else if (spent >
           parameters.plate.seating_time + parameters.plate.seating_max_time)
    throw RunFailure(unseated_text());
}

/// A load in balance may pass through a plate that swings: its motion would
/// change the load by sqrt(kinetic / elastic energy).
bool Compaction::is_seated() const
{
  const PlateParameters &p = parameters.plate;
  const double swing = plate->energy().kinetic /
                       std::max(synchronized().energy().elastic, 1e-300);
  return std::abs(plate_load() / weight() - 1.) < p.seating_load_tolerance &&
         swing < p.seating_load_tolerance * p.seating_load_tolerance &&
         dem::unbalanced_force_ratio(synchronized()) <
             p.seating_unbalanced_ratio;
}

std::string Compaction::unseated_text() const
{
  const PlateParameters &p = parameters.plate;
  const double unbalanced = dem::unbalanced_force_ratio(synchronized());
  return "plate and particles are not at rest within Plate/seating_max_time "
         "= " +
         number_text(p.seating_max_time) +
         " s after Plate/seating_time: load on the plate " +
         number_text(plate_load()) + " N (static load " +
         number_text(weight()) + ", Plate/seating_load_tolerance = " +
         number_text(p.seating_load_tolerance) + "), its speed " +
         number_text(plate->velocity()) + " m/s, unbalanced force ratio " +
         number_text(unbalanced) + " (Plate/seating_unbalanced_ratio = " +
         number_text(p.seating_unbalanced_ratio) +
         "): allow more time or wider tolerances, or raise Time/local_damping";
}
} // namespace spall
