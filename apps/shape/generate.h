#pragma once

#include "shape/report.h"
#include "shape/words.h"

namespace spall
{
/// spall shape generate: writes particles with the statistics of a sample and
/// prints the figures of both side by side.
int generate_shapes(const ShapeWords &words);
} // namespace spall
