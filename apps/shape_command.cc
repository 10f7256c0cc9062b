#include "commands.h"
#include "errors.h"
#include "shape_file.h"

#include <dem/io/mesh_reader.h>
#include <dem/shape/measures.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <numbers>
#include <stdexcept>

namespace spall
{
namespace
{
constexpr const char *usage =
    "needs fit MESH --order N --out S.json [--max-overhang F] "
    "[--unit m|mm|um] [--source TEXT] [--licence TEXT], or info S.json|MESH "
    "[--unit m|mm|um]";

[[noreturn]] void fail_usage(const std::string &what = "")
{
  throw InputError("shape: " + what + usage);
}

struct ShapeWords
{
  std::string file;
  std::string out;
  std::string source, licence;
  std::string unit = "m";
  int order = 20;
  double max_overhang = 0.02; ///< of all directions [-]
  bool has_order = false, has_unit = false;
};

template <typename Number>
Number number(const std::string &option, const std::string &word,
              const std::string &allowed)
{
  Number value = 0;
  const char *end = word.data() + word.size();
  const auto [stop, error] = std::from_chars(word.data(), end, value);
  if (error != std::errc() || stop != end)
    throw InputError("shape: " + option + " is \"" + word + "\", must be " +
                     allowed);
  return value;
}

void set_order(ShapeWords &words, const std::string &word)
{
  const std::string allowed =
      "a whole number 1 .. " + std::to_string(dem::max_order);
  words.order = number<int>("--order", word, allowed);
  words.has_order = true;
  if (words.order < 1 || words.order > dem::max_order)
    throw InputError("shape: --order is " + word + ", must be " + allowed);
}

void set_overhang(ShapeWords &words, const std::string &word)
{
  words.max_overhang = number<double>("--max-overhang", word, "0 .. 1");
  if (!(words.max_overhang >= 0. && words.max_overhang <= 1.))
    throw InputError("shape: --max-overhang is " + word + ", must be 0 .. 1");
}

void set_option(ShapeWords &words, const std::string &option,
                const std::string &word)
{
  if (option == "--order")
    set_order(words, word);
  else if (option == "--max-overhang")
    set_overhang(words, word);
  else if (option == "--out")
    words.out = word;
  else if (option == "--unit")
  {
    metres(word); // throws if unknown
    words.unit = word;
    words.has_unit = true;
  }
  else if (option == "--source")
    words.source = word;
  else if (option == "--licence")
    words.licence = word;
  else
    throw InputError("shape: " + option +
                     " is no option: must be one of --order, --out, "
                     "--max-overhang, --unit, --source, --licence");
}

ShapeWords parse(Words words)
{
  ShapeWords parsed;
  for (std::size_t i = 0; i < words.size(); ++i)
  {
    if (words[i].starts_with("--"))
    {
      if (i + 1 == words.size())
        throw InputError("shape: " + words[i] + " needs a value");
      set_option(parsed, words[i], words[i + 1]);
      ++i;
    }
    else if (parsed.file.empty())
      parsed.file = words[i];
    else
      throw InputError("shape: \"" + words[i] +
                       "\" is one word too many: one file at a time");
  }
  if (parsed.file.empty())
    fail_usage();
  return parsed;
}

dem::TriangleMesh mesh_in_metres(const ShapeWords &words)
{
  dem::TriangleMesh mesh = dem::read_mesh(words.file);
  for (dem::Vec3 &point : mesh.points)
    point *= metres(words.unit);
  return mesh;
}

dem::ShapeFit fit_file(const ShapeWords &words, double max_overhang)
{
  const dem::TriangleMesh mesh = mesh_in_metres(words);
  try
  {
    return dem::fit_shape(mesh, words.order, max_overhang);
  }
  catch (const std::invalid_argument &error)
  {
    throw InputError(words.file + ": " + error.what());
  }
}

void print(const char *what, double value, const char *unit)
{
  std::printf("  %-34s %12.6g %s\n", what, value, unit);
}

void print_series(const dem::Coefficients &coefficients)
{
  const dem::ShapeMeasures of =
      dem::measure_shape(coefficients, dem::standard_quadrature());
  std::printf("series of order %d\n", dem::order_of(coefficients.size()));
  print("volume", of.volume, "m^3");
  print("area", of.area, "m^2");
  print("volume-equivalent diameter",
        std::cbrt(6. * of.volume / std::numbers::pi), "m");
  print("ball radius", of.mean_radius, "m");
  print("smallest radius", of.inscribed_radius, "m");
  print("largest radius", of.circumscribed_radius, "m");
  print("centroid from the origin", of.centroid.norm(), "m");
  const Eigen::SelfAdjointEigenSolver<dem::Mat3> axes(of.inertia,
                                                      Eigen::EigenvaluesOnly);
  for (const double moment : axes.eigenvalues())
    print("principal inertia, unit density", moment, "m^5");
  print("sphericity (Wadell)", of.sphericity, "-");
  print("roundness (R_g)", of.roundness, "-");
  print("share of corners in the area", of.corner_fraction, "-");
}

void print_fit(const dem::ShapeFit &fit)
{
  std::printf("mesh\n");
  print("volume", fit.mesh_volume, "m^3");
  print("area", fit.mesh_area, "m^2");
  print("directions with more than one hit", 100. * fit.overhang_fraction, "%");
  print("volume changed by the outermost hit", 100. * fit.overhang_loss, "%");
  print("residual of the fit, rms", 100. * fit.residual_rms,
        "% of the mean radius");
  print("residual of the fit, largest", 100. * fit.residual_max,
        "% of the mean radius");
}

int fit_command(const ShapeWords &words)
{
  if (words.out.empty() || !words.has_order)
    fail_usage();
  const dem::ShapeFit fit = fit_file(words, words.max_overhang);
  ShapeFile shape;
  shape.order = words.order;
  shape.coefficients = fit.coefficients;
  shape.name = std::filesystem::path(words.out).stem().string();
  shape.source = words.source.empty()
                     ? std::filesystem::path(words.file).filename().string()
                     : words.source;
  shape.licence = words.licence;
  write_shape(words.out, shape);
  print_fit(fit);
  print_series(fit.coefficients);
  std::printf("%s written\n", words.out.c_str());
  return 0;
}

int info_command(const ShapeWords &words)
{
  if (!words.out.empty())
    fail_usage();
  if (std::filesystem::path(words.file).extension() == ".json")
  {
    if (words.has_unit || words.has_order)
      throw InputError("shape: --unit and --order are for a mesh; " +
                       words.file + " has its own");
    const ShapeFile shape = read_shape(words.file);
    std::printf("%s\n  source: %s\n  licence: %s\n", shape.name.c_str(),
                shape.source.c_str(), shape.licence.c_str());
    print_series(shape.coefficients);
    return 0;
  }
  // says how far from star-shaped it is, whatever the limit
  const dem::ShapeFit fit = fit_file(words, 1.);
  print_fit(fit);
  print_series(fit.coefficients);
  return 0;
}
} // namespace

int shape_command(Words words)
{
  if (words.empty() || (words[0] != "fit" && words[0] != "info"))
    fail_usage(words.empty() ? "" : words[0] + " is unknown, ");
  const ShapeWords parsed = parse(words.subspan(1));
  return words[0] == "fit" ? fit_command(parsed) : info_command(parsed);
}
} // namespace spall
