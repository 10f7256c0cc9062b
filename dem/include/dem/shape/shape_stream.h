#pragma once

#include <dem/shape/particle_shape.h>

#include <iosfwd>

namespace dem
{
/// All of a shape but its series, bit for bit.
void write_measures(std::ostream &out, const ParticleShape &shape);
/// Throws std::runtime_error at the end of the stream.
void read_measures(std::istream &in, ParticleShape &shape);
} // namespace dem
