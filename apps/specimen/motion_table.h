#pragma once

#include <dem/vector.h>

#include <string>
#include <vector>

namespace spall
{
/// Displacement of a wall by time.
struct MotionTable
{
  std::vector<double> time;     ///< rising, from 0 or later [s]
  std::vector<dem::Vec3> shift; ///< [m]
};

/// Reads a CSV with the header time_s,x_m,y_m,z_m. Throws InputError with file,
/// line and what is allowed.
MotionTable read_motion_table(const std::string &path);
} // namespace spall
