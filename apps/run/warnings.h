#pragma once

#include "run/energy_balance.h"
#include "run/progress.h"
#include "run/step_watch.h"

#include <coupling/cycle_jump.h>

#include <string>
#include <vector>

/// Warnings on the results of a run. The lines stand in
/// summary.json, at the end of the log and at the top of the report.
namespace spall
{
/// Contacts were deeper than Contact/overlap_warning.
void add_overlap_warning(const dem::Engine &engine,
                         std::vector<std::string> &warnings);

/// Steps were longer than the contacts allowed.
void add_step_warning(const TimeParameters &time, const StepRecord &record,
                      std::vector<std::string> &warnings);

/// Non-conservative work exceeds 1 % of the external work.
void add_energy_warning(const EnergyBalance &balance,
                        std::vector<std::string> &warnings);

/// The known errors of jumps over load cycles have added up to more than
/// CycleJump/tolerance of the values at `end`.
void add_jump_warning(const coupling::JumpAccount &jumps, double tolerance,
                      const coupling::SlowState &end,
                      std::vector<std::string> &warnings);

/// A line of the log for each.
void say_warnings(Progress &progress, const std::vector<std::string> &warnings);
} // namespace spall
