#include "run/event_rows.h"

namespace spall
{
std::string events_header(const std::string &progress)
{
  return "time_s" + (progress == "time_s" ? "" : "," + progress) +
         ",particle_1,other_1,kind_1,mode_1,force_before_N,"
         "force_after_N,overlap_m,elastic_energy_J,fracture_energy_J,"
         "released_energy_J,removed_volume_m3,kernel_width_rad,depth_m,"
         "equivalent_radius_m";
}

std::vector<double> event_row(const dem::BreakageEvent &e,
                              const std::string &progress, double progress_at)
{
  std::vector<double> row{e.time};
  if (progress != "time_s")
    row.push_back(progress_at);
  for (const double value :
       {static_cast<double>(e.particle), static_cast<double>(e.other),
        static_cast<double>(e.kind), static_cast<double>(e.mode),
        e.force_before, e.force_after, e.overlap, e.elastic_energy,
        e.fracture_energy, e.released_energy, e.removed_volume, e.width,
        e.depth, e.equivalent_radius})
    row.push_back(value);
  return row;
}
} // namespace spall
