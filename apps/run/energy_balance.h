#pragma once

#include <nlohmann/json_fwd.hpp>

#include <string>

namespace spall
{
/// Energy balance of a run, or of a part of it (docs/theory/energies.md).
struct EnergyBalance
{
  double external_work = 0.; ///< done on particles and bodies [J]
  /// External work less all energies and losses that are booked [J].
  double residual = 0.;
  /// Work on the normal springs less the energy that they store [J]: error of
  /// the time integration, rotation under a force along the branch, change of
  /// the stiffness with the contact point. Negative: energy was injected.
  double non_conservative_work = 0.;

  EnergyBalance &operator-=(const EnergyBalance &start);
  /// |residual| over |external work|; 0 without external work [-].
  double closure() const;
  /// Non-conservative work over |external work|, with its sign; 0 without
  /// external work [-].
  double non_conservative_ratio() const;
};

/// A line for the log.
std::string describe(const EnergyBalance &balance);

/// Adds energy_residual_ratio_1 and non_conservative_work_ratio_1.
void add_energy_balance(const EnergyBalance &balance,
                        nlohmann::ordered_json &summary);
} // namespace spall
