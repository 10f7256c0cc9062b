#pragma once

#include <cstdint>

namespace coupling
{
/// Errors of a load cycle that a step may make, relative [-].
struct StepTolerances
{
  double force = 0.01, energy = 0.01;
};

/// What the two runs of a window are compared by.
struct ProbeWindow
{
  double axial = 0., lateral = 0.; ///< sums of the boundary forces [N]
  double residual = 0.;            ///< change of the energy residual [J]
  double work = 0.;                ///< size of the external work [J]
  double stored = 0.;              ///< elastic energy at the end [J]
};

/// Where a probe stands, and what the last ones found; plain data for the
/// checkpoint.
struct ProbeState
{
  std::int64_t fine_left = 0; ///< steps of the finer run still to do
  std::int64_t n_coarse = 0;  ///< steps of the coarse run
  double coarse_step = 0.;    ///< [s]
  ProbeWindow coarse, fine;
  double residual_start = 0., work_start = 0.; ///< at the window's start [J]
  double longest = 0.; ///< that the tolerances allow; 0: not evaluated [s]
  /// Running means over a load cycle, carried over to the present step: of
  /// squared force errors [-], of the residual that falls with the step, signed
  /// [W].
  double force_variance = 0., residual_power = 0.;
  double work_power = 0.;   ///< running mean of sizes [W]
  double stored_power = 0.; ///< ProbeScene::stored_power, last [W]
  std::int64_t n_probes = 0, n_extra_steps = 0;
};

/// Relative errors of one load cycle with the present step, as the probes
/// estimate them; energy over external work or, if more, stored energy [-].
struct StepErrors
{
  double force = 0., energy = 0.;
};

StepErrors errors_of(const ProbeState &state);

/// Further input of a probe.
struct ProbeScene
{
  double duration = 0.;     ///< of the window [s]
  double stable = 0.;       ///< longest step without tolerances [s]
  double stored_power = 0.; ///< elastic energy over the load period [W]
  int n_per_cycle = 1;      ///< probes that are one load cycle [-]
};

/// Takes in the two runs of a window and sets the longest step that the
/// tolerances allow, between a twentieth of the stable one and that.
void adapt(const StepTolerances &tolerances, const ProbeScene &scene,
           ProbeState &state);
} // namespace coupling
