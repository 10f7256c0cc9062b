// The report of a dynamic triaxial test.
#include "report/figure_parts.h"
#include "report/kind_report.h"
#include "report/text.h"
#include "triaxial/kind.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace spall
{
namespace
{
/// Rows of a history that are drawn over the cycles.
enum class Sampling
{
  every_row,
  cycle_ends,
  both ///< a faint line and the ends of the cycles
};

struct DrawnQuantity
{
  std::string id;
  ReportSection section;
  std::string column, y_label, caption;
  double factor = 1.; ///< unit of the column in units of the label
  Sampling sampling = Sampling::cycle_ends;
};

const std::vector<DrawnQuantity> quantities{
    {"permanent_axial_strain", ReportSection::response, "axial_strain_1",
     "Permanent axial strain (%)",
     "Permanent axial strain at the end of each cycle. Compression is "
     "positive; zero is the start of loading.",
     100.},
    {"permanent_volumetric_strain", ReportSection::response,
     "volumetric_strain_1", "Permanent volumetric strain (%)",
     "Permanent volumetric strain at the end of each cycle. Compression is "
     "positive, dilation negative.",
     100.},
    {"abrasion", ReportSection::breakage, "laa_percent", "Abrasion LAA (%)",
     "Abrasion LAA: mass lost by breakage divided by the initial mass.", 1.,
     Sampling::every_row},
    {"roundness", ReportSection::breakage, "roundness_1", "Roundness Rg (–)",
     "Roundness Rg, mean of all particles at the end of each cycle. The value "
     "1 "
     "is a particle without corners."},
    {"coordination_number", ReportSection::network, "coordination_number_1",
     "Coordination number (–)",
     "Mechanical coordination number: at the ends of the cycles (markers) and "
     "within them (faint line).",
     1., Sampling::both},
    {"contact_force", ReportSection::network, "mean_contact_force_N",
     "Mean contact force (N)",
     "Mean contact force between particles: at the ends of the cycles "
     "(markers) and within them (faint line).",
     1., Sampling::both}};

Chart over_cycles(const DrawnQuantity &quantity)
{
  return {quantity.id, quantity.section, quantity.caption, cycle_label,
          quantity.y_label};
}

std::vector<std::size_t> ends_with_last(const Table &loading)
{
  std::vector<std::size_t> rows = cycle_ends(loading);
  if (rows.size() == 1 && loading.n_rows() > 1)
    rows.push_back(loading.n_rows() - 1);
  return rows;
}

void add_run(const DrawnQuantity &quantity, std::span<const RunData> runs,
             std::size_t k, Chart &chart)
{
  const Table &loading = runs[k].loading;
  const Column *cycle = find_or_note(loading, "cycle_1", runs[k], chart);
  const Column *value = find_or_note(loading, quantity.column, runs[k], chart);
  if (!cycle || !value)
    return;
  const Column y = scaled(*value, quantity.factor);
  Curve curve = run_curve(runs, k);
  const bool has_ends = quantity.sampling != Sampling::every_row;
  // Several oscillating lines would hide each other.
  if (!has_ends || (quantity.sampling == Sampling::both && runs.size() == 1))
  {
    curve.x = *cycle;
    curve.y = y;
    if (has_ends)
    {
      Curve faint = curve;
      faint.name.clear();
      faint.csv_name = "within the cycles";
      faint.colour = "#b9cfdd";
      faint.line_width = 1.;
      chart.curves.push_back(faint);
    }
  }
  if (has_ends)
  {
    const std::vector<std::size_t> rows = ends_with_last(loading);
    curve.csv_name = curve.name.empty() ? "ends of the cycles" : "";
    curve.x = picked(*cycle, rows);
    curve.y = picked(y, rows);
    curve.marker = rows.size() <= 60 ? Marker::dot : Marker::none;
  }
  chart.curves.push_back(curve);
}

Chart quantity_chart(const DrawnQuantity &quantity,
                     std::span<const RunData> runs)
{
  Chart chart = over_cycles(quantity);
  for (std::size_t k = 0; k < runs.size(); ++k)
    add_run(quantity, runs, k, chart);
  if (runs.size() > 1 && quantity.sampling == Sampling::both)
    chart.caption = chart.caption.substr(0, chart.caption.find(':')) +
                    " at the end of each cycle.";
  return chart;
}

Chart event_count_chart(std::span<const RunData> runs)
{
  const DrawnQuantity count{"breakage_count",
                            ReportSection::breakage,
                            "n_events_1",
                            "Breakage events (–)",
                            "Number of breakage events since the start.",
                            1.,
                            Sampling::every_row};
  return quantity_chart(count, runs);
}

std::vector<Chart> make_charts(std::span<const RunData> runs)
{
  std::vector<Chart> charts{loop_chart(runs)};
  for (const DrawnQuantity &quantity : quantities)
    charts.push_back(quantity_chart(quantity, runs));
  for (const Chart &chart : cycle_charts(runs))
    charts.push_back(chart);
  for (const Chart &chart : profile_charts(runs))
    charts.push_back(chart);
  charts.push_back(event_count_chart(runs));
  for (const Chart &chart : event_charts(runs))
    charts.push_back(chart);
  for (const Chart &chart : energy_charts(runs))
    charts.push_back(chart);
  charts.push_back(residual_chart(runs));
  return charts;
}

double permanent_strain_percent(const RunData &run)
{
  return 100. *
         number_or_last(run, "permanent_axial_strain_1", "axial_strain_1");
}

double coordination_change(const RunData &run)
{
  const std::vector<double> *values = run.loading.find("coordination_number_1");
  const double change = values && !values->empty()
                            ? values->back() - values->front()
                            : std::numeric_limits<double>::quiet_NaN();
  const double said = number(run.summary, "coordination_change_1");
  return std::isfinite(said) ? said : change;
}

std::string prepared_stress(const nlohmann::ordered_json &summary)
{
  const auto found = summary.find("preparation");
  if (found == summary.end() || !found->is_object() ||
      !found->contains("stress_Pa") || !(*found)["stress_Pa"].is_array())
    return "–";
  std::string out;
  for (const nlohmann::ordered_json &stress : (*found)["stress_Pa"])
    out += (out.empty() ? "" : " / ") +
           (stress.is_number() ? format(1e-3 * stress.get<double>(), 3) : "–");
  return out;
}

double in_preparation(const nlohmann::ordered_json &summary,
                      const std::string &key)
{
  const auto found = summary.find("preparation");
  return found != summary.end() && found->is_object()
             ? number(*found, key)
             : std::numeric_limits<double>::quiet_NaN();
}

/// A number of the summary at the start and at the end of the loading.
std::string start_to_end(const nlohmann::ordered_json &summary,
                         const std::string &name)
{
  return number_text_of(summary, name + "_start_1", 1., 3) + " → " +
         number_text_of(summary, name + "_end_1", 1., 3);
}

std::vector<SummaryRow> make_rows()
{
  return {
      text_row(ReportSection::boundaries, "Lateral boundary", "lateral"),
      number_row(ReportSection::specimen, "Initial porosity (–)",
                 "initial_porosity"),
      {ReportSection::specimen, "Prepared stress x / y / z (kPa)",
       [](const RunData &run) { return prepared_stress(run.summary); }},
      {ReportSection::specimen, "Prepared unbalanced force ratio (–)",
       [](const RunData &run) {
         return format(in_preparation(run.summary, "unbalanced_force_ratio_1"),
                       2);
       }},
      {ReportSection::response, "Cycles (–)",
       [](const RunData &run) { return format(last(run, "cycle_1"), 3); }},
      {ReportSection::response, "Permanent axial strain (%)",
       [](const RunData &run)
       { return format(permanent_strain_percent(run), 4); }},
      number_row(ReportSection::response,
                 "Largest deviatoric stress q = axial - lateral (kPa)",
                 "peak_deviatoric_stress_Pa", 1e-3),
      number_row(ReportSection::response, "Axial strain at the largest q (%)",
                 "axial_strain_at_peak_1", 100.),
      number_row(ReportSection::response, "Largest stress ratio q / p (–)",
                 "peak_stress_ratio_1"),
      number_row(ReportSection::response,
                 "Largest mobilised friction angle (°)",
                 "peak_friction_angle_deg"),
      {ReportSection::breakage, "Abrasion LAA (%)",
       [](const RunData &run) { return format(abrasion_percent(run), 4); }},
      {ReportSection::specimen, "Porosity, start → end (–)",
       [](const RunData &run)
       { return start_to_end(run.summary, "porosity"); }},
      {ReportSection::specimen, "Void ratio, start → end (–)",
       [](const RunData &run)
       { return start_to_end(run.summary, "void_ratio"); }},
      {ReportSection::network, "Coordination number, start → end (–)",
       [](const RunData &run)
       { return start_to_end(run.summary, "coordination"); }},
      number_row(ReportSection::response,
                 "Resilient axial strain, last cycle (%)",
                 "resilient_axial_strain_1", 100.),
      number_row(ReportSection::response, "Resilient modulus, last cycle (MPa)",
                 "resilient_modulus_Pa", 1e-6),
      number_row(ReportSection::response, "Damping ratio, last cycle (–)",
                 "damping_ratio_1"),
      number_row(ReportSection::network, "Change of the mean contact force (%)",
                 "mean_contact_force_change_1", 100.),
      {ReportSection::network,
       "Particles in force chains, at rest / under load (%)",
       [](const RunData &run)
       {
         return number_pair(run.summary, "force_chain_share_1",
                            "force_chain_share_peak_1", 100.);
       }},
      {ReportSection::network,
       "Anisotropy of the fabric, at rest / under load (–)",
       [](const RunData &run)
       {
         return number_pair(run.summary, "fabric_anisotropy_1",
                            "fabric_anisotropy_peak_1", 1.);
       }},
      {ReportSection::network, "Sliding contacts, at rest / under load (%)",
       [](const RunData &run)
       {
         return number_pair(run.summary, "sliding_fraction_1",
                            "sliding_fraction_peak_1", 100.);
       }},
      {ReportSection::response,
       "Axial stress under load, inside / at the plate (kPa)",
       [](const RunData &run)
       {
         return number_pair(run.summary, "inside_axial_stress_peak_Pa",
                            "wall_axial_stress_peak_Pa", 1e-3);
       }},
      {ReportSection::boundaries,
       "Porosity at the end, lateral skin / inside (–)",
       [](const RunData &run)
       {
         return number_pair(run.summary, "porosity_skin_1", "porosity_inside_1",
                            1.);
       }},
      number_row(
          ReportSection::boundaries,
          "Bulge: section in the middle over that at the ends, minus one (%)",
          "bulge_1", 100., 3)};
}
} // namespace

const KindReport &triaxial_report()
{
  static const KindReport report = {
      .headlines = {{"Permanent axial strain", " %", permanent_strain_percent},
                    {"Abrasion LAA", " %", abrasion_percent},
                    {"Change of coordination number", "", coordination_change,
                     true}},
      .rows = make_rows(),
      .charts = make_charts};
  return report;
}
} // namespace spall
