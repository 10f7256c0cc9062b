#pragma once

#include <dem/shape/particle_shape.h>

#include <string>
#include <vector>

namespace spall
{
/// A shape file: JSON {name, order, convention, unit, source, licence,
/// coefficients}.
struct ShapeFile
{
  int order = 0;
  dem::Coefficients coefficients; ///< [m], whatever unit the file has
  std::string name, source, licence;
  std::string path; ///< it was read from
};

/// Length of a unit, m, mm or um [m]. Throws InputError.
double metres(const std::string &unit);

/// Throws InputError with one clear line: file, key, what is allowed.
ShapeFile read_shape(const std::string &path);

/// In metres. Throws InputError if the file cannot be written.
void write_shape(const std::string &path, const ShapeFile &shape);

/// Every *.json of a folder, sorted by name. Throws InputError if none.
std::vector<ShapeFile> read_shapes(const std::string &folder);
} // namespace spall
