#include "shape/mesh_fit.h"

#include "case/digits.h"
#include "errors.h"
#include "shape/file.h"
#include "shape/report.h"

#include <dem/io/mesh_reader.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <stdexcept>

namespace spall
{
namespace
{
/// Of particles that a file is taken to be in metres for, if nothing is said
/// of its unit [m].
constexpr double least_size = 1e-5, largest_size = 0.5;

} // namespace

dem::TriangleMesh mesh_in_metres(const ShapeWords &words)
{
  dem::TriangleMesh mesh = dem::read_mesh(words.inputs[0]);
  for (dem::Vec3 &point : mesh.points)
    point *= metres(words.unit);
  return mesh;
}

void require_unit(const ShapeWords &words, const dem::TriangleMesh &mesh)
{
  if (words.has_unit)
    return;
  dem::Vec3 lower = mesh.points[0], upper = lower;
  for (const dem::Vec3 &point : mesh.points)
  {
    lower = lower.cwiseMin(point);
    upper = upper.cwiseMax(point);
  }
  const double size = (upper - lower).maxCoeff();
  if (size >= least_size && size <= largest_size)
    return;
  const std::string found = in_four_digits(size);
  throw InputError(words.inputs[0] + ": is " + found +
                   " m across if it is in metres: give its unit, --unit mm "
                   "for " +
                   found + " mm, or --unit m if it is of that size");
}

TimedFit fit_file(const ShapeWords &words, const dem::FitOptions &options)
{
  using Clock = std::chrono::steady_clock;
  const dem::TriangleMesh mesh = mesh_in_metres(words);
  try
  {
    const Clock::time_point start = Clock::now();
    TimedFit timed{dem::fit_shape(mesh, words.order, options), 0.};
    timed.seconds = std::chrono::duration<double>(Clock::now() - start).count();
    require_unit(words, mesh);
    return timed;
  }
  catch (const std::invalid_argument &error)
  {
    throw InputError(words.inputs[0] + ": " + error.what());
  }
}

void warn_of_misfit(const std::string &path, const dem::ShapeFit &fit)
{
  if (has_misfit(fit))
    std::fprintf(stderr, "warning: %s: %s\n", path.c_str(),
                 misfit_text(fit).c_str());
}

void check_misfit(const ShapeWords &words, const dem::ShapeFit &fit)
{
  const double misfit =
      std::max(std::abs(fit.volume_error), std::abs(fit.length_error));
  if (misfit > words.max_misfit)
  {
    char allowed[120];
    std::snprintf(allowed, sizeof allowed,
                  "; at most %.3g %% allowed: take a higher order or give "
                  "--max-misfit",
                  100. * words.max_misfit);
    throw InputError(words.inputs[0] + ": " + misfit_text(fit) + allowed);
  }
  warn_of_misfit(words.inputs[0], fit);
}
} // namespace spall
