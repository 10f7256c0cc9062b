// Messages of a triaxial test while it runs.
#include "triaxial/triaxial.h"

#include <dem/measure/contact_springs.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace spall
{
/// Share of the preparation that is done, about, then of the load cycles. A
/// specimen that is longer on its way than expected is nearly there.
double Triaxial::share_done() const
{
  constexpr double nearly = 0.99;
  switch (now)
  {
  case Stage::preparation:
    return std::min(nearly, engine().time() / preparation_time());
  case Stage::consolidation:
    return 0.;
  case Stage::loading:
    return std::min(std::nextafter(1., 0.), cycle() / n_cycles);
  case Stage::done:
    break;
  }
  return 1.;
}

double Triaxial::duration() const
{
  const LoadPath &path = follower.path();
  const std::vector<double> periods =
      expected_periods(path, parameters.loading.confining_pressure);
  double length = parameters.loading.consolidation_time;
  for (std::size_t k = 0; k < periods.size(); ++k)
    length += periods[k] * path.stages[k].n_cycles();
  return length;
}

double Triaxial::progress_at(double time) const
{
  // From times alone, so that it does not matter when the row is written;
  // particles break from the start of loading only.
  return follower.cycles_at(time);
}

std::string Triaxial::phase() const
{
  if (now == Stage::preparation)
    return "preparation";
  if (now == Stage::consolidation)
    return "consolidation";
  char text[80];
  std::snprintf(text, sizeof text, "cycle %.2f/%d", cycle(), n_cycles);
  const std::size_t n_stages = follower.path().stages.size();
  return n_stages == 1 ? text
                       : "stage " + std::to_string(follower.index() + 1) + "/" +
                             std::to_string(n_stages) + ", " + text;
}

/// How near the preparation is to its rest, and when it will be there, where
/// that is known.
std::string Triaxial::preparation_numbers()
{
  const PreparationParameters &target = parameters.preparation;
  const dem::Vec3 stress = 1e-3 * preparation.stress;
  char text[120];
  std::snprintf(text, sizeof text,
                "stress %.3g %.3g %.3g of %.3g kPa, unbalanced force ratio "
                "%.1e of %.1e",
                stress.x(), stress.y(), stress.z(), 1e-3 * target.pressure,
                preparation.unbalanced_ratio, target.unbalanced_ratio);
  const bool has_its_stress =
      ((preparation.stress / target.pressure - dem::Vec3::Ones())
           .cwiseAbs()
           .array() < target.stress_tolerance)
          .all();
  if (!has_its_stress ||
      preparation.unbalanced_ratio <= target.unbalanced_ratio)
    return text;
  const double left =
      rest.after(run_time.seconds(), preparation.unbalanced_ratio);
  return std::isfinite(left) ? text + (", at rest in some " + in_minutes(left))
                             : text;
}

std::string Triaxial::live_numbers()
{
  if (now == Stage::preparation)
    return preparation_numbers();
  if (now == Stage::consolidation)
    return {};
  const Sample &last = recorded.last;
  char text[120];
  std::snprintf(text, sizeof text,
                "strain %.3f %%, LAA %.5f %%, coordination number %.2f",
                100. * last.axial_strain, last.laa, last.coordination_number);
  return text;
}

std::string Triaxial::outcome() const
{
  const Sample &start = recorded.loading_start, &end = recorded.last;
  char line[240];
  std::snprintf(line, sizeof line,
                "permanent axial strain %.4f %%, LAA %.5f %%, coordination "
                "number %.3f -> %.3f, %.0f events",
                100. * end.axial_strain, end.laa, start.coordination_number,
                end.coordination_number, end.n_events);
  return line;
}

std::string Triaxial::prepared_text() const
{
  const dem::Vec3 &stress = preparation.stress;
  char line[200];
  std::snprintf(line, sizeof line,
                "prepared in %.3f s: stress %.0f %.0f %.0f Pa, unbalanced "
                "force ratio %.1e, porosity %.3f",
                preparation.time, stress.x(), stress.y(), stress.z(),
                preparation.unbalanced_ratio, preparation.porosity);
  return line;
}

std::string Triaxial::scaling_text() const
{
  char line[160];
  std::snprintf(line, sizeof line,
                "%zu particles below %.4g m, density up to %.4g times, %.3g %% "
                "of the mass added",
                scaling.n_scaled, parameters.time.density_scaling_diameter,
                scaling.largest_factor, 100. * scaling.added_mass);
  return line;
}

void Triaxial::note_prepared()
{
  say(prepared_text());
  if (parameters.time.density_scaling_diameter > 0.)
    say("density scaling: " + scaling_text());
}

std::string Triaxial::consolidated_text() const
{
  const Consolidated &c = consolidation;
  char line[200];
  std::snprintf(line, sizeof line,
                "consolidated in %.3f s: load on the plate within %.2g %%, "
                "unbalanced force ratio %.1e",
                c.time, 100. * std::max(c.load_error, c.motion_error),
                c.unbalanced_ratio);
  return line;
}

void Triaxial::describe() const
{
  if (const double cornered =
          dem::corner_step(engine().parameters(), engine().particles());
      std::isfinite(cornered))
    std::printf("in a corner      %.4g s (the same particle on three walls)\n",
                cornered);
  if (parameters.time.density_scaling_diameter > 0.)
    std::printf("density scaling  %s\n", scaling_text().c_str());
}

void Triaxial::describe_time(const MeanStep &mean) const
{
  if (!parameters.cycle_jump.is_on())
    return;
  const int all = follower.path().n_cycles(),
            simulated = coupling::least_cycles(parameters.cycle_jump, all);
  std::printf("with jumps       %.3g s if none is refused, for %d of %d "
              "cycles\n",
              mean.cost / mean.length *
                  (duration() - period() * (all - simulated)),
              simulated, all);
}
} // namespace spall
