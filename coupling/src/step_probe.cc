#include <coupling/step_probe.h>

#include <algorithm>
#include <cmath>

namespace coupling
{
StepErrors errors_of(const ProbeState &state)
{
  StepErrors errors;
  errors.force = std::sqrt(state.force_variance);
  const double scale = std::max(state.work_power, state.stored_power);
  errors.energy = scale > 0. ? std::abs(state.residual_power) / scale : 0.;
  return errors;
}

void adapt(const StepTolerances &tolerances, const ProbeScene &scene,
           ProbeState &state)
{
  // Second order: the coarse run is off by 4/3 of the difference.
  const auto relative = [](double coarse, double fine)
  { return fine != 0. ? 4. / 3. * (coarse - fine) / fine : 0.; };
  const double axial = relative(state.coarse.axial, state.fine.axial),
               lateral = relative(state.coarse.lateral, state.fine.lateral);
  ++state.n_probes;
  const double weight = 1. / static_cast<double>(std::min<std::int64_t>(
                                 state.n_probes, scene.n_per_cycle));
  const auto renew = [weight](double &mean, double value)
  { mean += weight * (value - mean); };
  renew(state.force_variance, std::max(axial * axial, lateral * lateral));
  // Only what the step can change: the rest of the residual stays anyway.
  renew(state.residual_power,
        4. / 3. * (state.coarse.residual - state.fine.residual) /
            scene.duration);
  state.stored_power = scene.stored_power;
  renew(state.work_power, state.coarse.work / scene.duration);

  const StepErrors errors = errors_of(state);
  const double share = std::max(errors.force / tolerances.force,
                                errors.energy / tolerances.energy);
  const double factor =
      share > 0. ? std::clamp(0.9 / std::sqrt(share), 0.5, 1.1) : 1.1;
  state.longest =
      std::clamp(factor * state.coarse_step, 0.05 * scene.stable, scene.stable);
  // What is remembered is what the new step would have made.
  const double change = std::pow(state.longest / state.coarse_step, 2);
  state.force_variance *= change * change;
  state.residual_power *= change;
}
} // namespace coupling
