#pragma once

#include <dem/measure/region_stress.h>

namespace dem
{
/// Share of the space in a prism that is particle, overlaps once [-]. From
/// points in a hundred horizontal sections.
double solid_fraction(const Prism &space, const ParticleSystem &particles);
} // namespace dem
