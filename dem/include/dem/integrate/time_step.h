#pragma once

#include <dem/parameters/engine.h>
#include <dem/particles/particle_system.h>

#include <string>

namespace dem
{
/// A step and what sets it.
struct StepLimit
{
  double step = 0.;   ///< [s]
  std::string reason; ///< for the log
};

/// Longest stable step of the scene as it is set up: the smallest of
/// 2 sqrt(m / k) (sqrt(1 + beta^2) - beta) over the linear walls with
/// the lightest particle (lagged dashpot), across the wall and, with the
/// turning of the equivalent sphere and its rolling spring, along it; and the
/// Rayleigh step pi r sqrt(rho / G) / (0.1631 nu + 0.8766) of the smallest body
/// of every material. `surface` names the facet surface and the key of its
/// stiffness.
StepLimit critical_step(
    const EngineParameters &parameters, const ParticleSystem &particles,
    const std::string &surface = "the membrane "
                                 "(MembraneContact/normal_stiffness)");
} // namespace dem
