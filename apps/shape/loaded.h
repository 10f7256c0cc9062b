#pragma once

#include "shape/file.h"

#include <memory>
#include <string>
#include <vector>

namespace spall
{
/// What a run takes of a shape file.
struct LoadedShape
{
  std::shared_ptr<const dem::Coefficients> coefficients; ///< [m]
  /// Lines for the user: what was changed, what the series does not carry.
  std::vector<std::string> warnings;
};

/// The series of a file, cut at an order, with its origin at its centroid: the
/// motion takes the origin as centre of mass. A centroid farther than 1 % of
/// the mean radius from the origin is made the origin. Throws InputError with
/// file and number where the series has no radius above zero everywhere, or
/// where it deviates by more than 1 % of the mean radius when it is moved.
LoadedShape loaded_shape(const ShapeFile &shape, int order);

/// The same; warnings go to standard error.
std::shared_ptr<const dem::Coefficients>
load_with_warnings(const ShapeFile &shape, int order);

/// The series of a file that a run has written, cut at an order: its origin
/// stays where it is, as it did in that run. Throws InputError where the series
/// has no radius above zero everywhere.
std::shared_ptr<const dem::Coefficients> as_written(const ShapeFile &shape,
                                                    int order);

/// A line on how much the series adds in its upper third of degrees;
/// empty where it is little [-].
std::string resolution_warning(const dem::Coefficients &coefficients);
} // namespace spall
