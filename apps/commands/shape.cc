#include "commands/commands.h"
#include "errors.h"
#include "shape/corners.h"
#include "shape/file.h"
#include "shape/generate.h"
#include "shape/loaded.h"
#include "shape/mesh_fit.h"
#include "shape/report.h"
#include "shape/words.h"

#include <dem/shape/spherical_harmonics.h>

#include <cstdio>
#include <filesystem>

namespace spall
{
namespace
{
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
                     "\" is a second file: one file at a time");
  if (words.count > 0 || words.has_seed)
    throw InputError("shape: --count and --seed are for generate");
  if (words.has_patch)
    throw InputError("shape: --patch is for corners");
}

int fit_command(const ShapeWords &words)
{
  require_one_input(words);
  if (!words.has_order)
    throw InputError("shape: --order N must be set: the order of the series, "
                     "such as 15");
  if (words.out.empty())
    throw InputError("shape: --out S.json must be set: the file of the shape");
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
  if (words[0] == "corners")
    return compare_shape_corners(parsed);
  fail_shape_usage(words[0] + " is unknown, ");
}
} // namespace spall
