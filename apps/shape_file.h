#pragma once

#include <dem/shape/body.h>

#include <string>
#include <vector>

namespace spall
{
/// A shape file: JSON {order, convention, coefficients, unit, source, licence}.
struct ShapeFile
{
  int order = 0;
  dem::Coefficients coefficients; ///< [m], whatever unit the file has
  std::string name, source, licence;
};

/// Throws InputError with one clear line: file, key, what is allowed.
ShapeFile read_shape(const std::string &path);
void write_shape(const std::string &path, const ShapeFile &shape);

/// Every *.json of a folder, sorted by name. Throws InputError if none.
std::vector<ShapeFile> read_shapes(const std::string &folder);
} // namespace spall
