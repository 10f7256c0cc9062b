// Figures of cycles.csv and of the boundary profiles.
#include "report/figure_parts.h"

#include <algorithm>
#include <array>
#include <string>

namespace spall
{
namespace
{
/// A column of cycles.csv; a second one is drawn beside it for one run alone.
struct CycleQuantity
{
  const char *id;
  ReportSection section;
  const char *column, *y_label, *caption;
  double factor = 1.; ///< unit of the column in units of the label
  const char *peak = nullptr;
};

constexpr std::array cycle_quantities = {
    CycleQuantity{"resilient_strain", ReportSection::response,
                  "resilient_axial_strain_1", "Resilient axial strain (%)",
                  "Resilient axial strain: the strain recovered on unloading, "
                  "one value for each cycle.",
                  100.},
    CycleQuantity{"resilient_modulus", ReportSection::response,
                  "resilient_modulus_Pa", "Resilient modulus (MPa)",
                  "Resilient modulus: cyclic axial stress divided by the "
                  "resilient axial strain.",
                  1e-6},
    CycleQuantity{"damping_ratio", ReportSection::response, "damping_ratio_1",
                  "Damping ratio (–)",
                  "Damping ratio: area of the stress-strain loop divided by 4π "
                  "times the energy of the single amplitudes."},
    CycleQuantity{"force_chains", ReportSection::network, "force_chain_share_1",
                  "Particles in force chains (%)",
                  "Share of the particles that belong to force chains (Peters "
                  "et al. 2005)",
                  100., "force_chain_share_peak_1"},
    CycleQuantity{"fabric_anisotropy", ReportSection::network,
                  "fabric_anisotropy_1", "Anisotropy of the fabric (–)",
                  "Anisotropy of the contact normals; 0 is isotropic", 1.,
                  "fabric_anisotropy_peak_1"},
    CycleQuantity{"sliding_fraction", ReportSection::network,
                  "sliding_fraction_1", "Sliding contacts (%)",
                  "Share of the contacts at the Coulomb limit", 100.,
                  "sliding_fraction_peak_1"},
    CycleQuantity{"stress_inside", ReportSection::response,
                  "inside_axial_stress_Pa", "Axial stress inside (kPa)",
                  "Mean axial stress inside the specimen, without the layer "
                  "along its boundary",
                  1e-3, "inside_axial_stress_peak_Pa"}};

/// An axis of a chart: a column and its unit in units of the label.
struct AxisColumn
{
  std::string name;
  double factor = 1.;
};

/// Adds one column of a table over another, or a note why not.
void add_curve(const RunData &run, const Table &table, const AxisColumn &x,
               const AxisColumn &y, Curve curve, Chart &chart)
{
  const Column *of_x = find_or_note(table, x.name, run, chart);
  const Column *of_y = find_or_note(table, y.name, run, chart);
  if (!of_x || !of_y)
    return;
  curve.x = scaled(*of_x, x.factor);
  curve.y = scaled(*of_y, y.factor);
  curve.marker = curve.x.size() <= 60 ? Marker::dot : Marker::none;
  chart.curves.push_back(curve);
}

/// The style of a second curve of one run.
Curve second_curve(const std::string &name)
{
  Curve curve;
  curve.name = name;
  curve.colour = palette_colour(1);
  curve.dash = palette_dash(1);
  return curve;
}

Chart cycle_chart(const CycleQuantity &quantity, std::span<const RunData> runs)
{
  Chart chart{quantity.id, quantity.section, quantity.caption, cycle_label,
              quantity.y_label};
  const bool has_both = quantity.peak && runs.size() == 1;
  if (quantity.peak)
    chart.caption += has_both ? ", at the end of each cycle and in its middle "
                                "under the largest load."
                              : ", at the end of each cycle.";
  const AxisColumn x{"cycle_1"}, y{quantity.column, quantity.factor};
  for (std::size_t k = 0; k < runs.size(); ++k)
  {
    Curve curve = run_curve(runs, k);
    if (has_both)
      curve.name = "end of cycle";
    add_curve(runs[k], runs[k].cycles, x, y, curve, chart);
    if (has_both)
      add_curve(runs[k], runs[k].cycles, x, {quantity.peak, quantity.factor},
                second_curve("middle of cycle"), chart);
  }
  return chart;
}

/// Over the distance from a boundary of the specimen.
struct ProfileQuantity
{
  const char *id;
  ReportSection section;
  const char *column, *x_label, *y_label, *caption;
  double factor = 1.;
};

constexpr std::array profile_quantities = {
    ProfileQuantity{"porosity_lateral", ReportSection::boundaries,
                    "porosity_lateral_1",
                    "Distance from the lateral boundary (mm)", "Porosity (%)",
                    "Porosity near the lateral boundary, in the part of the "
                    "specimen away from the platens.",
                    100.},
    ProfileQuantity{"coordination_lateral", ReportSection::boundaries,
                    "coordination_lateral_1",
                    "Distance from the lateral boundary (mm)",
                    "Coordination number (–)",
                    "Coordination number near the lateral boundary, in the "
                    "part of the specimen away from the platens."},
    ProfileQuantity{"porosity_platens", ReportSection::boundaries,
                    "porosity_platens_1",
                    "Distance from the nearer platen (mm)", "Porosity (%)",
                    "Porosity near the platens, in the part of the specimen "
                    "away from the lateral boundary.",
                    100.}};

/// Tables of the start and of the end of loading.
struct Ends
{
  Table RunData::*start, RunData::*end;
  AxisColumn x, y;
};

/// Start and end of one run, or the ends of several.
Chart chart_of_ends(Chart chart, const Ends &ends,
                    std::span<const RunData> runs)
{
  for (std::size_t k = 0; k < runs.size(); ++k)
  {
    const RunData &run = runs[k];
    if (runs.size() > 1)
    {
      add_curve(run, run.*ends.end, ends.x, ends.y, run_curve(runs, k), chart);
      continue;
    }
    Curve curve = run_curve(runs, k);
    curve.name = "start of loading";
    add_curve(run, run.*ends.start, ends.x, ends.y, curve, chart);
    add_curve(run, run.*ends.end, ends.x, ends.y,
              second_curve("end of loading"), chart);
  }
  if (runs.size() > 1)
    chart.caption += " State at the end of loading.";
  return chart;
}

Chart profile_chart(const ProfileQuantity &quantity,
                    std::span<const RunData> runs)
{
  return chart_of_ends({quantity.id, quantity.section, quantity.caption,
                        quantity.x_label, quantity.y_label},
                       {&RunData::profile_start,
                        &RunData::profile_end,
                        {"distance_m", 1e3},
                        {quantity.column, quantity.factor}},
                       runs);
}

Chart section_chart(std::span<const RunData> runs)
{
  return chart_of_ends({"sections", ReportSection::boundaries,
                        "Bulging of the specimen: area of its horizontal "
                        "sections from the base to the plate.",
                        "Section (cm²)",
                        "Height over that of the specimen (–)"},
                       {&RunData::sections_start,
                        &RunData::sections_end,
                        {"section_m2", 1e4},
                        {"height_share_1"}},
                       runs);
}
} // namespace

std::vector<Chart> cycle_charts(std::span<const RunData> runs)
{
  std::vector<Chart> charts;
  if (std::ranges::any_of(runs, [](const RunData &run)
                          { return run.cycles.n_rows() > 0; }))
    for (const CycleQuantity &quantity : cycle_quantities)
      charts.push_back(cycle_chart(quantity, runs));
  return charts;
}

std::vector<Chart> profile_charts(std::span<const RunData> runs)
{
  std::vector<Chart> charts;
  if (std::ranges::any_of(runs, [](const RunData &run)
                          { return run.profile_start.n_rows() > 0; }))
    for (const ProfileQuantity &quantity : profile_quantities)
      charts.push_back(profile_chart(quantity, runs));
  if (std::ranges::any_of(runs, [](const RunData &run)
                          { return run.sections_start.n_rows() > 0; }))
    charts.push_back(section_chart(runs));
  return charts;
}
} // namespace spall
