// The report of a plate on a subgrade.
#include "report/figure_parts.h"
#include "report/kind_report.h"
#include "report/path_charts.h"
#include "report/roundness_chart.h"
#include "subgrade/kind.h"

#include <array>
#include <cmath>
#include <filesystem>

namespace spall
{
namespace
{
/// One line of a chart: a column and what it is called there.
struct Line
{
  std::string column, name;
};

struct Axes
{
  std::string x, x_label;
  double x_factor = 1., y_factor = 1.;
};

/// Names of lines and of runs, where there are several of either.
std::string name_of(std::span<const RunData> runs, std::size_t k,
                    const Line &line, std::size_t n_lines)
{
  if (runs.size() == 1)
    return n_lines > 1 ? line.name : "";
  return n_lines > 1 ? runs[k].name + ", " + line.name : runs[k].name;
}

/// `tables`: one of each run.
void add_lines(std::span<const RunData> runs, const std::vector<Table> &tables,
               const Axes &axes, const std::vector<Line> &lines, Chart &chart)
{
  chart.x_label = axes.x_label;
  for (std::size_t k = 0; k < runs.size(); ++k)
    for (std::size_t l = 0; l < lines.size(); ++l)
    {
      const Column *x = find_or_note(tables[k], axes.x, runs[k], chart);
      const Column *y =
          find_or_note(tables[k], lines[l].column, runs[k], chart);
      if (!x || !y)
        continue;
      Curve curve;
      curve.name = name_of(runs, k, lines[l], lines.size());
      curve.colour = palette_colour(runs.size() > 1 ? k : l);
      curve.dash = palette_dash(l);
      curve.x = scaled(*x, axes.x_factor);
      curve.y = scaled(*y, axes.y_factor);
      chart.curves.push_back(curve);
    }
}

const Axes over_time{"loading_time_s", "Time of loading (s)"};

Axes over_time_in(double factor)
{
  Axes axes = over_time;
  axes.y_factor = factor;
  return axes;
}

std::vector<Table> histories(std::span<const RunData> runs)
{
  std::vector<Table> tables;
  for (const RunData &run : runs)
    tables.push_back(run.loading);
  return tables;
}

/// A table of the run folders; empty ones where it is missing.
std::vector<Table> tables_named(std::span<const RunData> runs,
                                const std::string &file)
{
  std::vector<Table> tables;
  for (const RunData &run : runs)
  {
    const auto path = std::filesystem::path(run.folder) / file;
    tables.push_back(std::filesystem::exists(path) ? read_table(path.string())
                                                   : Table{});
  }
  return tables;
}

std::vector<Line> stress_lines(const Table &table)
{
  const std::string start = "vertical_stress_", end = "m_Pa";
  std::vector<Line> lines;
  for (const std::string &name : table.names)
    if (name.starts_with(start) && name.ends_with(end))
      lines.push_back(
          {name,
           name.substr(start.size(), name.size() - start.size() - end.size()) +
               " m deep"});
  return lines;
}

/// Rows of profile.csv of one part.
Table part_of(const Table &table, double part)
{
  Table result;
  result.names = table.names;
  result.columns.resize(table.names.size());
  const Column *parts = table.find("part_1");
  for (std::size_t row = 0; parts && row < parts->size(); ++row)
    if ((*parts)[row] == part)
      for (std::size_t c = 0; c < table.columns.size(); ++c)
        result.columns[c].push_back(table.columns[c][row]);
  return result;
}

Chart profile_chart(std::span<const RunData> runs)
{
  Chart chart{
      "velocity_profile", ReportSection::response,
      "Velocity profile below the plate: root mean square and peak velocity "
      "of the particles during the loading, and peak velocity of the subgrade. "
      "Height zero is the top of the subgrade.",
      "", "Height (m)"};
  std::vector<Table> particles, ground;
  for (const Table &table : tables_named(runs, "profile.csv"))
  {
    particles.push_back(part_of(table, 0.));
    ground.push_back(part_of(table, 1.));
  }
  // Height is drawn upward: the columns are exchanged.
  const auto add = [&](const std::vector<Table> &tables,
                       const std::string &column, const std::string &name,
                       std::size_t style)
  {
    const Axes axes{column, "Velocity (mm/s)", 1e3};
    Chart part{"", chart.section, ""};
    add_lines(runs, tables, axes, {{"height_m", name}, {"height_m", ""}}, part);
    for (std::size_t k = 0; k < part.curves.size(); k += 2)
    {
      part.curves[k].colour = palette_colour(style);
      part.curves[k].marker = Marker::dot;
      chart.curves.push_back(part.curves[k]);
    }
    chart.x_label = axes.x_label;
  };
  add(particles, "velocity_rms_m_per_s", "particles, rms", 0);
  add(particles, "velocity_peak_m_per_s", "particles, peak", 1);
  add(ground, "velocity_peak_m_per_s", "subgrade, peak", 2);
  return chart;
}

Chart bowl_chart(std::span<const RunData> runs)
{
  Chart chart{"settlement_bowl", ReportSection::boundaries,
              "Settlement of the surface of the subgrade along x below the "
              "middle of the plate: at its deepest and at the end.",
              "", "Settlement (mm)"};
  add_lines(runs, tables_named(runs, "bowl.csv"), {"x_m", "x (m)", 1., 1e3},
            {{"settlement_peak_m", "deepest"}, {"settlement_end_m", "end"}},
            chart);
  return chart;
}

Chart transfer_chart(std::span<const RunData> runs)
{
  Chart chart{
      "transfer_function", ReportSection::response,
      "Transfer function: velocity of plate and subgrade divided by the "
      "force of the pulses, as a ratio of Fourier integrals. Only "
      "frequencies that the pulses contain are shown.",
      "", "Mobility (mm/s per kN)"};
  add_lines(runs, tables_named(runs, "transfer.csv"),
            {"frequency_Hz", "Frequency (Hz)", 1., 1e6},
            {{"plate_mobility_m_per_sN", "plate"},
             {"subgrade_mobility_m_per_sN", "subgrade"}},
            chart);
  return chart;
}

Chart energy_chart(std::span<const RunData> runs)
{
  Chart chart{
      "energies", ReportSection::energy,
      "Work of weight, plate and pulses, dissipation and stored energies since "
      "the first particle. Elastic energy is that of particles and subgrade.",
      "", "Energy (J)"};
  add_lines(runs, histories(runs), over_time,
            {{"external_work_J", "external work"},
             {"friction_dissipation_J", "friction"},
             {"damping_dissipation_J", "damping and radiation"},
             {"rolling_dissipation_J", "rolling"},
             {"elastic_energy_J", "elastic"},
             {"kinetic_energy_J", "kinetic"},
             {"breakage_energy_J", "breakage"},
             {"energy_residual_J", "residual"}},
            chart);
  return chart;
}

struct TimeChart
{
  const char *id;
  ReportSection section;
  const char *caption, *y_label;
  double factor;
  std::vector<Line> lines;
};

std::vector<TimeChart> time_charts()
{
  return {
      {"settlement",
       ReportSection::response,
       "Settlement of the plate and of the top of the subgrade below it, "
       "relative to the equilibrium under the dead load.",
       "Settlement (mm)",
       1e3,
       {{"plate_settlement_m", "plate"},
        {"subgrade_settlement_m", "subgrade"}}},
      {"forces",
       ReportSection::boundaries,
       "Pulses on the plate, and forces of the particles on the plate and on "
       "the subgrade.",
       "Force (kN)",
       1e-3,
       {{"load_N", "pulses"},
        {"plate_force_N", "particles on plate"},
        {"subgrade_force_N", "particles on subgrade"}}},
      {"velocities",
       ReportSection::response,
       "Velocity of the plate and of the top of the subgrade, downward "
       "positive.",
       "Velocity (mm/s)",
       1e3,
       {{"plate_velocity_m_per_s", "plate"},
        {"subgrade_velocity_m_per_s", "subgrade"}}},
      {"particle_velocity",
       ReportSection::response,
       "Speed of the particles: root mean square of all particles, and speed "
       "of the fastest particle.",
       "Speed (mm/s)",
       1e3,
       {{"particle_velocity_rms_m_per_s", "rms"},
        {"particle_velocity_peak_m_per_s", "fastest"}}},
      {"coordination_number",
       ReportSection::network,
       "Mechanical coordination number of the particles.",
       "Coordination number (–)",
       1.,
       {{"coordination_number_1", ""}}},
      {"abrasion",
       ReportSection::breakage,
       "Abrasion LAA: mass lost by breakage divided by the initial mass.",
       "Abrasion LAA (%)",
       1.,
       {{"laa_percent", ""}}}};
}

std::vector<Chart> make_charts(std::span<const RunData> runs)
{
  const std::vector<Table> tables = histories(runs);
  std::vector<Chart> charts;
  for (const TimeChart &one : time_charts())
  {
    Chart chart{one.id, one.section, one.caption, "", one.y_label};
    add_lines(runs, tables, over_time_in(one.factor), one.lines, chart);
    charts.push_back(chart);
  }
  Chart stress{"stress", ReportSection::boundaries,
               "Vertical stress in the subgrade below the middle of the plate, "
               "increase over that of the dead load. Compression is positive.",
               "", "Stress (kPa)"};
  add_lines(runs, tables, over_time_in(1e-3), stress_lines(tables[0]), stress);
  charts.push_back(stress);
  charts.push_back(transfer_chart(runs));
  charts.push_back(profile_chart(runs));
  charts.push_back(bowl_chart(runs));
  charts.push_back(roundness_chart(runs));
  for (const Chart &chart : wall_charts(runs, {"time_s", "Time (s)"}))
    charts.push_back(chart);
  charts.push_back(energy_chart(runs));
  return charts;
}
} // namespace

const KindReport &subgrade_report()
{
  static const KindReport report = {
      .headlines = {{"Settlement of the plate", " mm",
                     [](const RunData &run)
                     { return 1e3 * last(run, "plate_settlement_m"); }},
                    {"Largest settlement of the subgrade", " mm",
                     [](const RunData &run) {
                       return 1e3 *
                              number(run.summary, "subgrade_settlement_peak_m");
                     }},
                    {"Fastest particle", " mm/s",
                     [](const RunData &run) {
                       return 1e3 * number(run.summary,
                                           "particle_velocity_peak_m_per_s");
                     }}},
      .rows =
          {number_row(ReportSection::response, "Settlement of the plate (mm)",
                      "plate_settlement_m", 1e3, 4),
           number_row(ReportSection::response,
                      "Largest settlement of the plate (mm)",
                      "plate_settlement_peak_m", 1e3, 4),
           number_row(ReportSection::response,
                      "Largest settlement of the subgrade (mm)",
                      "subgrade_settlement_peak_m", 1e3, 4),
           number_row(ReportSection::boundaries,
                      "Yielded share of the subgrade that can yield (%)",
                      "subgrade_yielded_share_1", 100., 3),
           number_row(ReportSection::energy,
                      "Plastic dissipation in the subgrade (J)",
                      "subgrade_plastic_dissipation_J", 1., 3),
           number_row(ReportSection::boundaries,
                      "Dead load on the subgrade (N)", "dead_load_N", 1., 4),
           number_row(ReportSection::boundaries,
                      "Peak force on the subgrade (N)", "subgrade_force_peak_N",
                      1., 4),
           number_row(ReportSection::boundaries, "Impulse of the pulses (N s)",
                      "pulse_impulse_Ns", 1., 4),
           number_row(ReportSection::breakage, "Abrasion LAA (%)",
                      "laa_percent", 1., 4)},
      .charts = make_charts};
  return report;
}
} // namespace spall
