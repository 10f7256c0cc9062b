#pragma once

#include <dem/vector.h>

#include <string>
#include <vector>

namespace spall
{
/// Particles as a packing file has them, in a box from 0 to `box`.
struct Packing
{
  dem::Vec3 box = dem::Vec3::Zero();        ///< upper corner [m]
  std::vector<dem::Vec3> position;          ///< [m]
  std::vector<double> radius;               ///< of the ball [m]
  std::vector<dem::Quaternion> orientation; ///< empty if the file has none

  std::size_t size() const { return radius.size(); }
};

/// Reads a CSV, plain or compressed by gzip: header `x,y,z,radius` or
/// `x,y,z,radius,qw,qx,qy,qz`, one particle per row. A comment `# box LX LY LZ`
/// gives the box; without it the box is a cube whose side follows from the
/// particles (side_of). Throws InputError with file, line and what is allowed.
Packing read_packing(const std::string &path);

/// With box and orientations, plain. Throws InputError if it cannot.
void write_packing(const std::string &path, const Packing &packing);

/// Side of the cube that particles in it press on alike from both ends: mean
/// over the axes of how far they reach up less how far they reach below zero,
/// to a tenth of a millimetre [m].
double side_of(const Packing &packing);
} // namespace spall
