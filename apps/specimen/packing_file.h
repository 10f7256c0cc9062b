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
  std::vector<dem::Vec3> velocity;          ///< the same [m/s]
  std::vector<dem::Vec3> spin;              ///< the same [rad/s]
  std::vector<std::string> shape;           ///< names of shape files, the same
  std::vector<std::string> material;        ///< names, the same
  std::vector<std::string> location;        ///< "file.csv:12"

  std::size_t size() const { return radius.size(); }
};

/// Reads a CSV, plain or compressed by gzip, one particle per row: columns
/// x,y,z and radius or diameter, and any of qw,qx,qy,qz, vx,vy,vz, wx,wy,wz,
/// shape and material. A comment `# box LX LY LZ` gives the box, else it is
/// zero. A file .json has the same columns as keys (json_table.h). Throws
/// InputError with file, line and what is allowed.
Packing read_placed_particles(const std::string &path);

/// The same for particles in a box: without that comment it is a cube whose
/// side follows from the particles (side_of). Throws InputError also on a
/// centre outside of the box.
Packing read_packing(const std::string &path);

/// With box and orientations, plain. Throws InputError if it cannot.
void write_packing(const std::string &path, const Packing &packing);

/// Side of the cube that particles in it press on alike from both ends: mean
/// over the axes of how far they reach up less how far they reach below zero,
/// to a tenth of a millimetre [m].
double side_of(const Packing &packing);
} // namespace spall
