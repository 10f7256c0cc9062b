#include "case/digits.h"
#include "commands/commands.h"
#include "errors.h"
#include "shape/file.h"
#include "shape/generate.h"
#include "shape/loaded.h"
#include "shape/report.h"
#include "shape/words.h"

#include <dem/io/mesh_reader.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <stdexcept>

namespace spall
{
namespace
{
/// A fit and the seconds it took.
struct TimedFit
{
  dem::ShapeFit fit;
  double seconds = 0.;
};

dem::TriangleMesh mesh_in_metres(const ShapeWords &words)
{
  dem::TriangleMesh mesh = dem::read_mesh(words.inputs[0]);
  for (dem::Vec3 &point : mesh.points)
    point *= metres(words.unit);
  return mesh;
}

/// Of particles that a file is taken to be in metres for, if nothing is said
/// of its unit [m].
constexpr double least_size = 1e-5, largest_size = 0.5;

/// Throws InputError for a mesh that is hardly in metres, unless --unit says
/// so.
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

/// Throws InputError where the series misses more of the mesh than allowed.
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

void report(const std::vector<ShapeFacts> &groups, const std::string &json)
{
  if (!json.empty())
    write_facts(json, groups);
  for (const ShapeFacts &group : groups)
    print_facts(group);
}

void require_one_input(const ShapeWords &words)
{
  if (words.inputs.empty())
    fail_shape_usage();
  if (words.inputs.size() > 1)
    throw InputError("shape: \"" + words.inputs[1] +
                     "\" is one word too many: one file at a time");
  if (words.count > 0 || words.has_seed)
    throw InputError("shape: --count and --seed are for generate");
}

int fit_command(const ShapeWords &words)
{
  require_one_input(words);
  if (words.out.empty() || !words.has_order)
    fail_shape_usage();
  const TimedFit timed = fit_file(words, words.fit);
  check_misfit(words, timed.fit);
  ShapeFile shape;
  shape.order = words.order;
  shape.coefficients = timed.fit.coefficients;
  shape.name = std::filesystem::path(words.out).stem().string();
  shape.source =
      words.source.empty()
          ? std::filesystem::path(words.inputs[0]).filename().string()
          : words.source;
  shape.licence = words.licence;
  write_shape(words.out, shape);
  report({fit_facts(timed.fit, timed.seconds),
          series_facts(timed.fit.coefficients)},
         words.json);
  std::printf("%s written\n", words.out.c_str());
  return 0;
}

int info_of_series(const ShapeWords &words)
{
  if (words.has_unit || words.has_order || words.has_fit)
    throw InputError("shape: --unit, --order, --from, --max-overhang and "
                     "--max-misfit are for a mesh; " +
                     words.inputs[0] + " is a series");
  const ShapeFile shape = read_shape(words.inputs[0]);
  std::printf("%s\n  source: %s\n  licence: %s\n", shape.name.c_str(),
              shape.source.c_str(), shape.licence.c_str());
  report({series_facts(shape.coefficients)}, words.json);
  // What a run makes of it, and what it refuses.
  for (const std::string &line : loaded_shape(shape, dem::max_order).warnings)
    std::fprintf(stderr, "warning: %s\n", line.c_str());
  return 0;
}

int info_command(const ShapeWords &words)
{
  require_one_input(words);
  if (!words.out.empty())
    fail_shape_usage();
  if (std::filesystem::path(words.inputs[0]).extension() == ".json")
    return info_of_series(words);
  dem::FitOptions options = words.fit;
  options.max_overhang = 1.; // says how far from star-shaped, whatever it is
  const TimedFit timed = fit_file(words, options);
  report({fit_facts(timed.fit, timed.seconds),
          series_facts(timed.fit.coefficients)},
         words.json);
  warn_of_misfit(words.inputs[0], timed.fit);
  return 0;
}
} // namespace

int shape_command(Words words)
{
  if (words.empty())
    fail_shape_usage();
  const ShapeWords parsed = parse_shape_words(words.subspan(1));
  if (words[0] == "fit")
    return fit_command(parsed);
  if (words[0] == "info")
    return info_command(parsed);
  if (words[0] == "generate")
    return generate_shapes(parsed);
  fail_shape_usage(words[0] + " is unknown, ");
}
} // namespace spall
