#pragma once

#include "case.h"

namespace spall
{
/// What the two runs of a window are compared by.
struct Window
{
  double axial = 0., lateral = 0.; ///< sums of the boundary forces [N]
  double residual = 0.;            ///< change of the energy residual [J]
  double work = 0.;                ///< size of the external work [J]
};

/// Where a probe stands, and what the last ones found; plain data for the
/// checkpoint.
struct ProbeState
{
  std::int64_t fine_left = 0; ///< steps of the finer run still to do
  std::int64_t n_coarse = 0;  ///< steps of the coarse run
  double coarse_step = 0.;    ///< [s]
  Window coarse, fine;
  double residual_start = 0., work_start = 0.; ///< at the window's start [J]
  double longest = 0.;        ///< that the tolerances allow; 0: not asked [s]
  double force_variance = 0.; ///< running mean of squared errors [-]
  double residual_power = 0.; ///< running mean, signed [W]
  double work_power = 0.;     ///< running mean of sizes [W]
  std::int64_t n_probes = 0, n_extra_steps = 0;
};

/// Relative errors of one load cycle as the probes estimate them [-].
struct StepErrors
{
  double force = 0., energy = 0.;
};

StepErrors errors_of(const ProbeState &state);

/// Takes in the two runs of a window, both over `duration` [s], and sets the
/// longest step that the tolerances allow, between a twentieth of `stable` and
/// `stable` [s]; `n_per_cycle` probes are one load cycle.
void adapt(const TimeParameters &parameters, double duration, double stable,
           int n_per_cycle, ProbeState &state);
} // namespace spall
