#include "shape/corners.h"

#include "errors.h"
#include "report/chart.h"
#include "run/whole_file.h"
#include "shape/corner_picture.h"
#include "shape/file.h"
#include "shape/mesh_fit.h"
#include "shape/report.h"

#include <dem/shape/mesh_curvature.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <stdexcept>

namespace spall
{
namespace
{
namespace fs = std::filesystem;

void require_words(const ShapeWords &words)
{
  if (words.inputs.empty() || words.out.empty())
    fail_shape_usage();
  if (words.inputs.size() > 2)
    throw InputError("shape: \"" + words.inputs[2] +
                     "\" is one word too many: one mesh and one series");
  if (words.count > 0 || words.has_seed)
    throw InputError("shape: --count and --seed are for generate");
  if (words.inputs.size() > 1 && (words.has_order || words.has_fit))
    throw InputError("shape: --order, --from, --max-overhang and --max-misfit "
                     "are for a fit; " +
                     words.inputs[1] + " is a series");
}

/// The second input, or a fit to the first one.
dem::Coefficients series_of(const ShapeWords &words)
{
  if (words.inputs.size() > 1)
    return read_shape(words.inputs[1]).coefficients;
  const TimedFit timed = fit_file(words, words.fit);
  check_misfit(words, timed.fit);
  return timed.fit.coefficients;
}

dem::CornerComparison compare(const ShapeWords &words,
                              const dem::Coefficients &series)
{
  const dem::TriangleMesh mesh = mesh_in_metres(words);
  try
  {
    dem::CornerComparison compared =
        dem::compare_corners(mesh, series, words.patch);
    require_unit(words, mesh);
    return compared;
  }
  catch (const std::invalid_argument &error)
  {
    throw InputError(words.inputs[0] + ": " + error.what());
  }
}

/// Throws InputError where the series is not that of the mesh.
void require_residual(const ShapeWords &words,
                      const dem::CornerComparison &compared)
{
  if (compared.residual_rms <= words.max_misfit)
    return;
  char text[200];
  std::snprintf(text, sizeof text,
                ": its radius differs from that of the mesh by %.3g %% (rms), "
                "at most %.3g %% allowed: it must be a series of this mesh, "
                "in its position and unit",
                100. * compared.residual_rms, 100. * words.max_misfit);
  throw InputError(words.inputs.back() + text);
}

/// One warning for a mesh whose edges are longer than the patch.
void warn_of_coarse_mesh(const ShapeWords &words,
                         const dem::CornerComparison &compared)
{
  constexpr double coarse = 0.15; // edge over mean radius [-]
  const double mean_radius = compared.patch_radius / words.patch;
  if (compared.edge_length > coarse * mean_radius)
    std::fprintf(stderr,
                 "warning: %s: an edge has %.3g of the mean radius: too coarse "
                 "for curvatures, which need at most %.3g\n",
                 words.inputs[0].c_str(), compared.edge_length / mean_radius,
                 coarse);
}

ShapeFacts facts_of(const dem::CornerComparison &all)
{
  return {"corners",
          {{"points_1", "points of the mesh", "-", double(all.points.size())},
           {"edge_length_m", "mean edge of the mesh", "m", all.edge_length},
           {"patch_radius_m", "radius of the quadratic patches", "m",
            all.patch_radius},
           {"residual_rms_percent", "residual of r, rms / mean radius", "%",
            100. * all.residual_rms},
           {"inscribed_mesh_m", "inscribed radius of the mesh", "m",
            all.inscribed_mesh},
           {"inscribed_series_m", "inscribed radius of the series", "m",
            all.inscribed_series},
           {"median_difference_1", "kappa_max r_ins, median difference", "-",
            all.median_difference},
           {"corners_mesh_percent", "corners and edges, mesh", "% of area",
            100. * all.corners_mesh},
           {"corners_series_percent", "corners and edges, series", "% of area",
            100. * all.corners_series},
           {"corners_both_percent", "corners and edges of both", "% of area",
            100. * all.corners_both},
           {"agreement_percent", "mesh and series agree on", "% of area",
            100. * all.agreement}}};
}

std::string table_of(const dem::CornerComparison &compared)
{
  std::string text = "polar_rad,azimuth_rad,area_m2,radius_mesh_m,"
                     "radius_series_m,kappa_max_mesh_1_per_m,"
                     "kappa_max_series_1_per_m,corner_mesh_1,corner_series_1\n";
  for (const dem::ComparedPoint &point : compared.points)
  {
    char line[240];
    std::snprintf(line, sizeof line,
                  "%.6f,%.6f,%.6g,%.6g,%.6g,%.6g,%.6g,%d,%d\n",
                  std::acos(std::clamp(point.direction.z(), -1., 1.)),
                  std::atan2(point.direction.y(), point.direction.x()),
                  point.area, point.radius_mesh, point.radius_series,
                  point.curvature_mesh, point.curvature_series,
                  point.is_mesh_corner ? 1 : 0, point.is_series_corner ? 1 : 0);
    text += line;
  }
  return text;
}
} // namespace

int compare_shape_corners(const ShapeWords &words)
{
  require_words(words);
  const dem::Coefficients series = series_of(words);
  const dem::CornerComparison compared = compare(words, series);
  require_residual(words, compared);
  warn_of_coarse_mesh(words, compared);
  std::error_code error;
  if (!fs::create_directories(words.out, error) && error)
    throw InputError(words.out + ": cannot be made: " + error.message());
  const fs::path folder = words.out;
  write_asked(folder / "corners.csv", table_of(compared));
  write_asked(folder / "corners.svg", svg_file(corner_picture(compared)));
  const ShapeFacts facts = facts_of(compared);
  if (!words.json.empty())
    write_facts(words.json, {facts});
  print_facts(facts);
  std::printf("%s and %s written\n", (folder / "corners.csv").c_str(),
              (folder / "corners.svg").c_str());
  return 0;
}
} // namespace spall
