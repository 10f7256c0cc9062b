#include "shape/file.h"

#include "errors.h"
#include "run/whole_file.h"

#include <dem/shape/quadrature.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>

namespace spall
{
namespace
{
using Json = nlohmann::json;

constexpr const char *convention = "real orthonormal, no Condon-Shortley";

[[noreturn]] void fail(const std::string &path, const std::string &what)
{
  throw InputError(path + ": " + what);
}

Json parse(const std::string &path)
{
  if (!std::filesystem::exists(path))
    fail(path, "no such file");
  std::ifstream in(path);
  if (!in || std::filesystem::is_directory(path))
    fail(path, "cannot be read");
  try
  {
    Json json = Json::parse(in);
    if (!json.is_object())
      fail(path, "is not a JSON object");
    return json;
  }
  catch (const Json::exception &error)
  {
    fail(path, std::string("is not valid JSON: ") + error.what());
  }
}

const Json &entry(const std::string &path, const Json &json,
                  const std::string &key)
{
  const auto found = json.find(key);
  if (found == json.end())
    fail(path, "key \"" + key + "\" is missing");
  return *found;
}

std::string text(const std::string &path, const Json &json,
                 const std::string &key)
{
  const Json &value = entry(path, json, key);
  if (!value.is_string())
    fail(path, "key \"" + key + "\" must be text");
  return value.get<std::string>();
}

std::string optional_text(const std::string &path, const Json &json,
                          const std::string &key, const std::string &otherwise)
{
  return json.contains(key) ? text(path, json, key) : otherwise;
}

int read_order(const std::string &path, const Json &json)
{
  const Json &value = entry(path, json, "order");
  if (!value.is_number_integer() || value.get<std::int64_t>() < 0 ||
      value.get<std::int64_t>() > dem::max_order)
    fail(path, "order is " + value.dump() + ", must be a whole number 0 .. " +
                   std::to_string(dem::max_order));
  return value.get<int>();
}

void require_convention(const std::string &path, const Json &json)
{
  const std::string given = text(path, json, "convention");
  if (!given.starts_with(convention))
    fail(path, "convention is \"" + given + "\", must begin with \"" +
                   convention + "\"");
}

dem::Coefficients read_coefficients(const std::string &path, const Json &json,
                                    int order, double unit)
{
  const Json &list = entry(path, json, "coefficients");
  const auto wanted = std::size_t(dem::n_coefficients(order));
  if (!list.is_array() || list.size() != wanted)
    fail(path, "coefficients has " + std::to_string(list.size()) +
                   " entries, order " + std::to_string(order) + " has " +
                   std::to_string(wanted));
  dem::Coefficients coefficients;
  for (const Json &value : list)
  {
    if (!value.is_number() || !std::isfinite(value.get<double>()))
      fail(path, "coefficients[" + std::to_string(coefficients.size()) +
                     "] is " + value.dump() + ", must be a finite number");
    coefficients.push_back(unit * value.get<double>());
  }
  return coefficients;
}

void require_positive_radius(const std::string &path,
                             const dem::Coefficients &coefficients)
{
  const std::vector<double> radii =
      dem::node_radii(coefficients, dem::standard_quadrature());
  const auto [least, most] = std::minmax_element(radii.begin(), radii.end());
  if (!(*least > 0.))
    fail(path, "the radius of the shape is not above zero everywhere");
  if (!(*least >= 1e-9 && *most <= 1e3))
    fail(path, "the radius of the shape must be between 1e-9 and 1000 m "
               "everywhere");
}

/// One degree per line.
std::string coefficient_text(const ShapeFile &shape)
{
  std::string lines;
  for (int n = 0; n <= shape.order; ++n)
    for (int m = -n; m <= n; ++m)
    {
      const auto j = std::size_t(dem::harmonic_index(n, m));
      lines += m == -n ? (n == 0 ? "    " : ",\n    ") : ", ";
      lines += Json(shape.coefficients[j]).dump();
    }
  return lines;
}
} // namespace

double metres(const std::string &unit)
{
  if (unit == "m")
    return 1.;
  if (unit == "mm")
    return 1e-3;
  if (unit == "um")
    return 1e-6;
  throw InputError("unit is \"" + unit + "\", must be m, mm or um");
}

ShapeFile read_shape(const std::string &path)
{
  const Json json = parse(path);
  ShapeFile shape;
  shape.path = path;
  shape.order = read_order(path, json);
  require_convention(path, json);
  double unit = 1.;
  try
  {
    unit = metres(text(path, json, "unit"));
  }
  catch (const InputError &error)
  {
    const std::string what = error.what();
    throw InputError(what.starts_with(path) ? what : path + ": " + what);
  }
  shape.coefficients = read_coefficients(path, json, shape.order, unit);
  require_positive_radius(path, shape.coefficients);
  shape.name = optional_text(path, json, "name",
                             std::filesystem::path(path).stem().string());
  shape.source = optional_text(path, json, "source", "");
  shape.licence = optional_text(path, json, "licence", "");
  return shape;
}

void write_shape(const std::string &path, const ShapeFile &shape)
{
  std::ostringstream out;
  out << "{\n  \"name\": " << Json(shape.name).dump()
      << ",\n  \"order\": " << shape.order << ",\n  \"convention\": "
      << Json(std::string(convention) + " phase, j = n (n + 1) + m").dump()
      << ",\n  \"unit\": \"m\",\n  \"source\": " << Json(shape.source).dump()
      << ",\n  \"licence\": " << Json(shape.licence).dump()
      << ",\n  \"coefficients\": [\n"
      << coefficient_text(shape) << "\n  ]\n}\n";
  write_asked(path, out.str());
}

std::vector<ShapeFile> read_shapes(const std::string &folder)
{
  if (!std::filesystem::is_directory(folder))
    fail(folder, "no such folder of shapes");
  std::set<std::string> paths;
  for (const auto &item : std::filesystem::directory_iterator(folder))
    if (item.path().extension() == ".json")
      paths.insert(item.path().string());
  if (paths.empty())
    fail(folder, "has no shape files (*.json)");
  std::vector<ShapeFile> shapes;
  shapes.reserve(paths.size());
  for (const std::string &path : paths)
    shapes.push_back(read_shape(path));
  return shapes;
}
} // namespace spall
