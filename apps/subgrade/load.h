#pragma once

#include "case/case.h"

#include <fem/train_load.h>

#include <functional>
#include <vector>

namespace spall
{
fem::Train train_of(const PulseParameters &pulse);

/// The pulses on the plate over the time since loading began.
class SubgradeLoad
{
public:
  /// Throws InputError or std::invalid_argument on tables that cannot be read.
  explicit SubgradeLoad(const Case &parameters);

  double operator()(double time) const;      ///< down [N]; 0 before and after
  double duration() const { return length; } ///< of the pulses [s]
  /// When the axles stand on the sleeper; empty unless a train [s].
  const std::vector<double> &passes() const { return times; }
  double impulse() const { return total; } ///< exact, of all pulses [N s]

private:
  std::function<double(double)> force;
  double length = 0., total = 0.;
  std::vector<double> times;
};
} // namespace spall
