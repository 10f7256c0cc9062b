#include "shape/report.h"

#include "run/whole_file.h"

#include <dem/shape/form.h>
#include <dem/shape/measures.h>
#include <dem/shape/ringing.h>

#include <nlohmann/json.hpp>

#include <cmath>
#include <cstdio>
#include <numbers>

namespace spall
{
namespace
{
void add_size(const dem::Coefficients &coefficients,
              const dem::ShapeMeasures &of, std::vector<ShapeFact> &facts)
{
  const double diameter = std::cbrt(6. * of.volume / std::numbers::pi);
  const double free_radius = dem::inscribed_sphere(coefficients).radius;
  facts.insert(
      facts.end(),
      {{"volume_m3", "volume", "m^3", of.volume},
       {"area_m2", "area", "m^2", of.area},
       {"equivalent_diameter_m", "volume-equivalent diameter", "m", diameter},
       {"equivalent_radius_m", "equivalent radius", "m", of.mean_radius},
       {"inscribed_radius_m", "inscribed radius, smallest r", "m",
        of.inscribed_radius},
       {"inscribed_radius_free_m", "inscribed radius, free centre", "m",
        free_radius},
       {"circumscribed_radius_m", "largest r", "m", of.circumscribed_radius},
       {"centroid_m", "centroid from the origin", "m", of.centroid.norm()}});
}

void add_inertia(const dem::Mat3 &inertia, std::vector<ShapeFact> &facts)
{
  const char axes[] = "xyz";
  for (int i = 0; i < 3; ++i)
    for (int j = i; j < 3; ++j)
    {
      const std::string component = {axes[i], axes[j]};
      facts.push_back({"inertia_" + component + "_m5",
                       "inertia " + component + ", unit density", "m^5",
                       inertia(i, j)});
    }
  const Eigen::SelfAdjointEigenSolver<dem::Mat3> solver(inertia,
                                                        Eigen::EigenvaluesOnly);
  for (int i = 0; i < 3; ++i)
    facts.push_back({"principal_inertia_" + std::to_string(i + 1) + "_m5",
                     "principal inertia, unit density", "m^5",
                     solver.eigenvalues()[i]});
}

void add_form(const dem::Coefficients &coefficients,
              const dem::ShapeMeasures &of, std::vector<ShapeFact> &facts)
{
  const dem::Calipers form = dem::calipers(coefficients);
  const dem::Ringing ringing = dem::ringing(coefficients);
  facts.insert(
      facts.end(),
      {{"length_m", "L, largest Feret diameter", "m", form.length},
       {"width_m", "I, largest caliper across L", "m", form.width},
       {"thickness_m", "S, caliper across both", "m", form.thickness},
       {"elongation_1", "elongation I / L", "-", form.width / form.length},
       {"flatness_1", "flatness S / I", "-", form.thickness / form.width},
       {"sphericity_1", "sphericity (Wadell)", "-", of.sphericity},
       {"convexity_1", "convexity, volume / hull", "-",
        dem::convexity(coefficients)},
       {"roundness_1", "roundness (R_g)", "-", of.roundness},
       {"corner_fraction_1", "share of corners in the area", "-",
        of.corner_fraction},
       {"saddle_fraction_1", "share of directions, kappa_min < 0", "-",
        of.saddle_fraction},
       {"largest_curvature_1", "largest kappa_max r_mean", "-",
        of.max_curvature * of.mean_radius},
       {"ringing_rms_1", "ringing, rms / mean radius", "-", ringing.rms},
       {"ringing_largest_1", "ringing, largest / mean radius", "-",
        ringing.largest}});
}
} // namespace

ShapeFacts series_facts(const dem::Coefficients &coefficients)
{
  const dem::ShapeMeasures of =
      dem::measure_shape(coefficients, dem::standard_quadrature());
  ShapeFacts series{"series", {}};
  series.facts.push_back(
      {"order_1", "order", "-", double(dem::order_of(coefficients.size()))});
  add_size(coefficients, of, series.facts);
  add_inertia(of.inertia, series.facts);
  add_form(coefficients, of, series.facts);
  return series;
}

ShapeFacts fit_facts(const dem::ShapeFit &fit, double seconds)
{
  const dem::ShapeMeasures of =
      dem::measure_shape(fit.coefficients, dem::standard_quadrature());
  return {"mesh",
          {{"volume_m3", "volume", "m^3", fit.mesh_volume},
           {"area_m2", "area", "m^2", fit.mesh_area},
           {"points_welded_1", "points welded that were not equal", "-",
            double(fit.n_welded)},
           {"weld_distance_m", "distance within which they were", "m",
            fit.weld_distance},
           {"overhang_percent", "directions with more than one hit", "%",
            100. * fit.overhang_fraction},
           {"overhang_loss_percent", "volume changed by the outermost hit", "%",
            100. * fit.overhang_loss},
           {"residual_rms_percent", "residual of r, rms / mean radius", "%",
            100. * fit.residual_rms},
           {"residual_largest_percent", "residual of r, largest", "%",
            100. * fit.residual_max},
           {"volume_error_percent", "volume of the series - of the mesh", "%",
            100. * fit.volume_error},
           {"length_error_percent", "length of the series - of the mesh", "%",
            100. * fit.length_error},
           {"area_error_percent", "area of the series - of the mesh", "%",
            100. * (of.area / fit.mesh_area - 1.)},
           {"time_s", "time of the fit", "s", seconds}}};
}

bool has_misfit(const dem::ShapeFit &fit)
{
  constexpr double much_volume = 0.01, much_length = 0.05;
  return std::abs(fit.volume_error) > much_volume ||
         std::abs(fit.length_error) > much_length;
}

std::string misfit_text(const dem::ShapeFit &fit)
{
  char text[200];
  std::snprintf(text, sizeof text,
                "order %d does not carry the mesh: the volume of the series "
                "differs by %.3g %%, its length by %.3g %%",
                dem::order_of(fit.coefficients.size()), 100. * fit.volume_error,
                100. * fit.length_error);
  return text;
}

void print_facts(const ShapeFacts &facts)
{
  std::printf("%s\n", facts.title.c_str());
  for (const ShapeFact &fact : facts.facts)
    std::printf("  %-36s %12.6g %s\n", fact.label.c_str(), fact.value,
                fact.unit.c_str());
}

void write_facts(const std::string &path, const std::vector<ShapeFacts> &groups)
{
  nlohmann::ordered_json json;
  for (const ShapeFacts &group : groups)
    for (const ShapeFact &fact : group.facts)
      json[group.title][fact.key] = fact.value;
  write_asked(path, json.dump(2) + "\n");
}
} // namespace spall
