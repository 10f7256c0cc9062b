#include "run/warnings.h"

#include <dem/measure/totals.h>

#include <cmath>
#include <cstdio>

namespace spall
{
void add_overlap_warning(const dem::Engine &engine,
                         std::vector<std::string> &warnings)
{
  const double largest = dem::total_overlaps(engine).largest,
               limit = engine.parameters().geometry.overlap.warning;
  if (largest <= limit)
    return;
  char text[200];
  std::snprintf(text, sizeof text,
                "the largest overlap was %.3g of the radius of its particle, "
                "above Contact/overlap_warning = %.3g: Hertz theory does not "
                "hold for it",
                largest, limit);
  warnings.push_back(text);
}

void add_step_warning(const TimeParameters &time, const StepRecord &record,
                      std::vector<std::string> &warnings)
{
  if (time.step != StepRule::fixed || record.worst_share <= 1.)
    return;
  char text[200];
  std::snprintf(text, sizeof text,
                "Time/fixed_step = %.3g s was up to %.3g times what the "
                "contacts allowed: motion and forces may be unstable",
                time.fixed_step, record.worst_share);
  warnings.push_back(text);
}

void add_energy_warning(const EnergyBalance &balance,
                        std::vector<std::string> &warnings)
{
  constexpr double limit = 0.01;
  const double ratio = balance.non_conservative_ratio();
  if (std::abs(ratio) <= limit)
    return;
  char text[240];
  std::snprintf(text, sizeof text,
                "non-conservative work is %.3g %% of the external work, above "
                "%.3g %%: energy was %s by the time integration or the contact "
                "geometry (docs/theory/energies.md)",
                100. * ratio, 100. * limit, ratio < 0. ? "injected" : "lost");
  warnings.push_back(text);
}

void add_jump_warning(const coupling::JumpAccount &jumps, double tolerance,
                      const coupling::SlowState &end,
                      std::vector<std::string> &warnings)
{
  const auto add = [&](const char *name, double error, double value)
  {
    if (std::abs(error) <= tolerance * std::abs(value))
      return;
    char text[240];
    std::snprintf(text, sizeof text,
                  "jumps over load cycles: their known errors add up to %.3g "
                  "%% of the %s, above CycleJump/tolerance = %.3g",
                  100. * error / value, name, tolerance);
    warnings.push_back(text);
  };
  add("permanent axial strain", jumps.strain_error, end.strain);
  add("abrasion", jumps.abrasion_error, end.abrasion);
}

void say_warnings(Progress &progress, const std::vector<std::string> &warnings)
{
  for (const std::string &warning : warnings)
    progress.say("warning: " + warning);
}
} // namespace spall
