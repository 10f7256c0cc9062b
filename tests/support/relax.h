#pragma once

#include <fem/membrane.h>

#include <functional>

namespace support
{
using Loads = std::vector<Eigen::Vector3d>;

struct Relaxation
{
  double time_step = 0.; ///< [s]
  double duration = 0.;  ///< [s]
};

/// Advances the membrane; `set_loads` may fill the loads before each end_step.
inline void advance(fem::Membrane &membrane, const Relaxation &run,
                    const std::function<void(Loads &)> &set_loads = {})
{
  Loads loads(membrane.n_nodes(), Eigen::Vector3d::Zero());
  const auto n_steps = static_cast<int>(run.duration / run.time_step + 0.5);
  for (int step = 0; step < n_steps; ++step)
  {
    membrane.begin_step(run.time_step);
    if (set_loads)
      set_loads(loads);
    membrane.end_step(loads, run.time_step);
  }
}
} // namespace support
