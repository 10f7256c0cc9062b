#include "shape/loaded.h"

#include "errors.h"

#include <dem/shape/particle_shape.h>
#include <dem/shape/recentre.h>
#include <dem/shape/ringing.h>

#include <cstdio>
#include <stdexcept>

namespace spall
{
namespace
{
/// A centroid nearer to the origin is left there: what a fit leaves [-].
constexpr double small_offset = 0.01;
/// A series that is moved may change by this part of its mean radius [-].
constexpr double most_deviation = 0.01;
/// The upper third of the degrees adds less to a shape that its order carries
/// [-].
constexpr double much_ringing = 0.1;

std::string percent(double share)
{
  char text[32];
  std::snprintf(text, sizeof text, "%.3g %%", 100. * share);
  return text;
}

void require_radius(const ShapeFile &shape, const dem::Coefficients &series)
{
  const double mean = series[0] * dem::equivalent_radius_factor;
  const double least =
      mean > 0. ? dem::shape_of(series).least_radius / mean : 0.;
  if (!(least > 0.))
    throw InputError(shape.path + ": at order " +
                     std::to_string(dem::order_of(series.size())) +
                     " the smallest radius may be " + percent(least) +
                     " of the mean radius, must be above zero: the order does "
                     "not carry the shape");
}

dem::Coefficients cut_at(const ShapeFile &shape, int order)
{
  dem::Coefficients series = shape.coefficients;
  const auto kept = static_cast<std::size_t>(dem::n_coefficients(order));
  if (series.size() > kept)
    series.resize(kept);
  return series;
}

/// Moves the origin to the centroid and reports it.
void put_at_centroid(const ShapeFile &shape, dem::Coefficients &series,
                     std::vector<std::string> &warnings)
{
  const double offset = dem::relative_centroid(series).norm();
  if (offset <= small_offset)
    return;
  const std::string is_off = shape.path + ": the centroid is " +
                             percent(offset) +
                             " of the mean radius away from the origin";
  dem::Recentred moved;
  try
  {
    moved = dem::recentre(series);
  }
  catch (const std::invalid_argument &error)
  {
    throw InputError(is_off + " and cannot become the origin: " + error.what());
  }
  if (moved.deviation > most_deviation)
    throw InputError(is_off +
                     ", a series of the same order about the centroid "
                     "deviates by " +
                     percent(moved.deviation) +
                     " of the mean radius, at most " + percent(most_deviation) +
                     " allowed: fit the shape about its centroid");
  warnings.push_back(is_off +
                     "; the series was expanded about the centroid, "
                     "its surface deviates by at most " +
                     percent(moved.deviation));
  series = std::move(moved.coefficients);
}
} // namespace

std::string resolution_warning(const dem::Coefficients &coefficients)
{
  const double most = dem::ringing(coefficients).largest;
  if (!(most > much_ringing))
    return {};
  return "order " + std::to_string(dem::order_of(coefficients.size())) +
         " does not carry the shape: the upper third of its degrees adds up "
         "to " +
         percent(most) + " of the mean radius";
}

LoadedShape loaded_shape(const ShapeFile &shape, int order)
{
  dem::Coefficients series = cut_at(shape, order);
  LoadedShape loaded;
  put_at_centroid(shape, series, loaded.warnings);
  require_radius(shape, series);
  if (const std::string text = resolution_warning(series); !text.empty())
    loaded.warnings.push_back(shape.path + ": " + text);
  loaded.coefficients =
      std::make_shared<const dem::Coefficients>(std::move(series));
  return loaded;
}

std::shared_ptr<const dem::Coefficients> as_written(const ShapeFile &shape,
                                                    int order)
{
  dem::Coefficients series = cut_at(shape, order);
  if (series.size() < shape.coefficients.size())
    require_radius(shape, series);
  return std::make_shared<const dem::Coefficients>(std::move(series));
}

std::shared_ptr<const dem::Coefficients>
load_with_warnings(const ShapeFile &shape, int order)
{
  LoadedShape loaded = loaded_shape(shape, order);
  for (const std::string &line : loaded.warnings)
    std::fprintf(stderr, "warning: %s\n", line.c_str());
  return loaded.coefficients;
}
} // namespace spall
