#pragma once

#include "subgrade/case.h"

#include <dem/particles/particle_system.h>

namespace spall
{
/// Share of the space right below a plate that is particle, overlaps once [-]:
/// from `low`, the ground, up to `high`, the plate [m].
double solid_fraction_below(const LoadPlateParameters &plate,
                            const dem::ParticleSystem &particles, double low,
                            double high);
} // namespace spall
