#include "step_probe.h"

#include <algorithm>
#include <cmath>

namespace spall
{
StepErrors errors_of(const ProbeState &state)
{
  StepErrors errors;
  errors.force = std::sqrt(state.force_variance);
  errors.energy = state.work_power > 0.
                      ? std::abs(state.residual_power) / state.work_power
                      : 0.;
  return errors;
}

void adapt(const TimeParameters &parameters, double duration, double stable,
           int n_per_cycle, ProbeState &state)
{
  // Second order: the coarse run is off by 4/3 of the difference.
  const auto relative = [](double coarse, double fine)
  { return fine != 0. ? 4. / 3. * (coarse - fine) / fine : 0.; };
  const double axial = relative(state.coarse.axial, state.fine.axial),
               lateral = relative(state.coarse.lateral, state.fine.lateral);
  ++state.n_probes;
  const double weight =
      1. /
      static_cast<double>(std::min<std::int64_t>(state.n_probes, n_per_cycle));
  const auto renew = [weight](double &mean, double value)
  { mean += weight * (value - mean); };
  renew(state.force_variance, std::max(axial * axial, lateral * lateral));
  renew(state.residual_power, state.coarse.residual / duration);
  renew(state.work_power, state.coarse.work / duration);

  const StepErrors errors = errors_of(state);
  const double share = std::max(errors.force / parameters.force_tolerance,
                                errors.energy / parameters.energy_tolerance);
  const double factor =
      share > 0. ? std::clamp(0.9 / std::sqrt(share), 0.5, 1.1) : 1.1;
  state.longest = std::clamp(factor * state.coarse_step, 0.05 * stable, stable);
}
} // namespace spall
