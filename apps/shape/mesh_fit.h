#pragma once

#include "shape/words.h"

#include <dem/shape/fit.h>

namespace spall
{
/// A fit and the seconds it took.
struct TimedFit
{
  dem::ShapeFit fit;
  double seconds = 0.;
};

/// The mesh of the first input, its unit applied [m].
dem::TriangleMesh mesh_in_metres(const ShapeWords &words);

/// Throws InputError for a mesh that is hardly in metres, unless --unit says
/// so.
void require_unit(const ShapeWords &words, const dem::TriangleMesh &mesh);

/// Fits the mesh of the first input. Throws InputError.
TimedFit fit_file(const ShapeWords &words, const dem::FitOptions &options);

/// Prints a warning where the series misses some of the mesh. Throws InputError
/// where it misses more than allowed.
void check_misfit(const ShapeWords &words, const dem::ShapeFit &fit);
void warn_of_misfit(const std::string &path, const dem::ShapeFit &fit);
} // namespace spall
