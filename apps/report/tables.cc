#include "report/tables.h"

#include "report/chart.h"
#include "report/text.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

namespace spall
{
namespace
{
using Json = nlohmann::ordered_json;

/// Last value of a column of the loading, or NaN.
double last(const RunData &run, const std::string &column)
{
  const std::vector<double> *values = run.loading.find(column);
  return values && !values->empty() ? values->back()
                                    : std::numeric_limits<double>::quiet_NaN();
}

/// From the summary, or from the history of a run without one.
double or_else(double value, double other)
{
  return std::isfinite(value) ? value : other;
}

double permanent_strain_percent(const RunData &run)
{
  return 100. * or_else(number(run.summary, "permanent_axial_strain_1"),
                        last(run, "axial_strain_1"));
}

double abrasion_percent(const RunData &run)
{
  return or_else(number(run.summary, "laa_percent"), last(run, "laa_percent"));
}

double coordination_change(const RunData &run)
{
  const std::vector<double> *values = run.loading.find("coordination_number_1");
  const double change = values && !values->empty()
                            ? values->back() - values->front()
                            : std::numeric_limits<double>::quiet_NaN();
  return or_else(number(run.summary, "coordination_change_1"), change);
}

struct Headline
{
  const char *name, *unit;
  double (*value)(const RunData &);
  bool has_sign; ///< a change: show + as well
};

constexpr Headline triaxial_headlines[]{
    {"Permanent axial strain", " %", permanent_strain_percent, false},
    {"Abrasion LAA", " %", abrasion_percent, false},
    {"Change of coordination number", "", coordination_change, true}};

constexpr Headline press_headlines[]{
    {"First event", " N",
     [](const RunData &run)
     { return number(run.summary, "first_event_force_N"); },
     false},
    {"Largest force", " N",
     [](const RunData &run) { return number(run.summary, "peak_force_N"); },
     false},
    {"Breakage events", "",
     [](const RunData &run) { return last(run, "n_events_1"); }, false}};

constexpr Headline drum_headlines[]{
    {"Abrasion LAA", " %", abrasion_percent, false},
    {"Turns", "", [](const RunData &run) { return last(run, "turn_1"); },
     false},
    {"Breakage events", "",
     [](const RunData &run) { return last(run, "n_events_1"); }, false}};

constexpr Headline compaction_headlines[]{
    {"Settlement", " mm",
     [](const RunData &run) { return 1e3 * last(run, "settlement_m"); }, false},
    {"Density", " kg/m³",
     [](const RunData &run) { return last(run, "density_kg_per_m3"); }, false},
    {"Abrasion LAA", " %", abrasion_percent, false}};

constexpr Headline subgrade_headlines[]{
    {"Settlement of the plate", " mm",
     [](const RunData &run) { return 1e3 * last(run, "plate_settlement_m"); },
     false},
    {"Subgrade at most", " mm",
     [](const RunData &run)
     { return 1e3 * number(run.summary, "subgrade_settlement_peak_m"); },
     false},
    {"Fastest particle", " mm/s",
     [](const RunData &run)
     { return 1e3 * number(run.summary, "particle_velocity_peak_m_per_s"); },
     false}};

/// Those of the kind of the first run.
std::span<const Headline> headlines_of(std::span<const RunData> runs)
{
  const Table &table = runs[0].loading;
  if (table.find("displacement_m"))
    return press_headlines;
  if (table.find("settlement_m"))
    return compaction_headlines;
  if (table.find("subgrade_settlement_m"))
    return subgrade_headlines;
  return table.find("turn_1") ? std::span<const Headline>(drum_headlines)
                              : triaxial_headlines;
}

std::string headline_value(const Headline &line, const RunData &run)
{
  const double value = line.value(run);
  const std::string sign = line.has_sign && value > 0. ? "+" : "";
  return sign + format(value, 3) + (std::isfinite(value) ? line.unit : "");
}

std::string text_of(const Json &summary, const std::string &key)
{
  const auto place = summary.find(key);
  if (place == summary.end() || place->is_null())
    return "–";
  if (place->is_string())
    return place->get<std::string>();
  return place->is_number_integer() ? std::to_string(place->get<long>())
                                    : place->dump();
}

std::string number_of(const Json &summary, const std::string &key,
                      double factor, int n_digits)
{
  return format(factor * number(summary, key), n_digits);
}

std::string prepared_stress(const Json &summary)
{
  const auto place = summary.find("preparation");
  if (place == summary.end() || !place->is_object() ||
      !place->contains("stress_Pa") || !(*place)["stress_Pa"].is_array())
    return "–";
  std::string out;
  for (const Json &stress : (*place)["stress_Pa"])
    out += (out.empty() ? "" : " / ") +
           (stress.is_number() ? format(1e-3 * stress.get<double>(), 3) : "–");
  return out;
}

double in_preparation(const Json &summary, const std::string &key)
{
  const auto place = summary.find("preparation");
  return place != summary.end() && place->is_object()
             ? number(*place, key)
             : std::numeric_limits<double>::quiet_NaN();
}

std::string particles(const Json &summary)
{
  return text_of(summary, "n_particles") + " (" +
         text_of(summary, "n_breakable") + " breakable)";
}

/// A number of the summary at the start and at the end of the loading.
std::string start_to_end(const Json &summary, const std::string &name)
{
  return number_of(summary, name + "_start_1", 1., 3) + " → " +
         number_of(summary, name + "_end_1", 1., 3);
}

/// Two numbers of the summary in one cell.
std::string number_pair(const Json &summary, const std::string &one,
                        const std::string &other, double factor)
{
  return number_of(summary, one, factor, 3) + " / " +
         number_of(summary, other, factor, 3);
}

struct Row
{
  std::string name;
  std::function<std::string(const RunData &)> value;
};

Row text_row(const std::string &name, const std::string &key)
{
  return {name,
          [key](const RunData &run) { return text_of(run.summary, key); }};
}

Row number_row(const std::string &name, const std::string &key,
               double factor = 1., int n_digits = 3)
{
  return {name, [=](const RunData &run)
          { return number_of(run.summary, key, factor, n_digits); }};
}

std::vector<Row> summary_rows()
{
  return {
      text_row("Title", "title"),
      text_row("Lateral boundary", "lateral"),
      {"Particles", [](const RunData &run) { return particles(run.summary); }},
      number_row("Volume of solids (cm³)", "solid_volume_m3", 1e6, 4),
      number_row("Initial porosity (–)", "initial_porosity"),
      {"Prepared stress x / y / z (kPa)",
       [](const RunData &run) { return prepared_stress(run.summary); }},
      {"Prepared unbalanced force ratio (–)",
       [](const RunData &run) {
         return format(in_preparation(run.summary, "unbalanced_force_ratio_1"),
                       2);
       }},
      {"Cycles (–)",
       [](const RunData &run) { return format(last(run, "cycle_1"), 3); }},
      {"Permanent axial strain (%)", [](const RunData &run)
       { return format(permanent_strain_percent(run), 4); }},
      {"Abrasion LAA (%)",
       [](const RunData &run) { return format(abrasion_percent(run), 4); }},
      {"Porosity, start → end (–)", [](const RunData &run)
       { return start_to_end(run.summary, "porosity"); }},
      {"Coordination number, start → end (–)", [](const RunData &run)
       { return start_to_end(run.summary, "coordination"); }},
      number_row("Resilient axial strain, last cycle (%)",
                 "resilient_axial_strain_1", 100.),
      number_row("Resilient modulus, last cycle (MPa)", "resilient_modulus_Pa",
                 1e-6),
      number_row("Damping ratio, last cycle (–)", "damping_ratio_1"),
      number_row("Change of the mean contact force (%)",
                 "mean_contact_force_change_1", 100.),
      {"Particles in force chains, at rest / under load (%)",
       [](const RunData &run)
       {
         return number_pair(run.summary, "force_chain_share_1",
                            "force_chain_share_peak_1", 100.);
       }},
      {"Anisotropy of the fabric, at rest / under load (–)",
       [](const RunData &run)
       {
         return number_pair(run.summary, "fabric_anisotropy_1",
                            "fabric_anisotropy_peak_1", 1.);
       }},
      {"Sliding contacts, at rest / under load (%)",
       [](const RunData &run)
       {
         return number_pair(run.summary, "sliding_fraction_1",
                            "sliding_fraction_peak_1", 100.);
       }},
      {"Axial stress under load, inside / at the plate (kPa)",
       [](const RunData &run)
       {
         return number_pair(run.summary, "inside_axial_stress_peak_Pa",
                            "wall_axial_stress_peak_Pa", 1e-3);
       }},
      {"Porosity at the end, lateral skin / inside (–)",
       [](const RunData &run)
       {
         return number_pair(run.summary, "porosity_skin_1", "porosity_inside_1",
                            1.);
       }},
      number_row("Bulge: section in the middle over the ends, less one (%)",
                 "bulge_1", 100., 3),
      number_row("Turns (–)", "turns_1", 1., 5),
      number_row("Mass lost (g)", "lost_mass_kg", 1e3, 4),
      {"Density asked / reached (kg/m³)",
       [](const RunData &run)
       {
         const auto filling = run.summary.find("filling");
         return filling == run.summary.end()
                    ? std::string("–")
                    : number_of(*filling, "density_asked_kg_per_m3", 1., 4) +
                          " / " +
                          number_of(*filling, "density_reached_kg_per_m3", 1.,
                                    4);
       }},
      number_row("Settlement while seated (mm)", "seating_settlement_m", 1e3,
                 4),
      number_row("Time of vibration (s)", "vibration_s", 1., 4),
      number_row("Settlement (mm)", "settlement_m", 1e3, 4),
      number_row("Density at the end (kg/m³)", "density_kg_per_m3", 1., 5),
      number_row("Static load (N)", "static_load_N", 1., 5),
      number_row("Force of the exciter (N)", "exciter_force_N", 1., 4),
      number_row("Displacement (mm)", "displacement_m", 1e3, 4),
      number_row("Force of the first event (N)", "first_event_force_N", 1., 4),
      number_row("Largest force (N)", "peak_force_N", 1., 4),
      number_row("Settlement of the plate (mm)", "plate_settlement_m", 1e3, 4),
      number_row("Settlement of the plate, at most (mm)",
                 "plate_settlement_peak_m", 1e3, 4),
      number_row("Settlement of the subgrade, at most (mm)",
                 "subgrade_settlement_peak_m", 1e3, 4),
      number_row("Subgrade that has yielded (% of what may)",
                 "subgrade_yielded_share_1", 100., 3),
      number_row("Plastic dissipation in the subgrade (J)",
                 "subgrade_plastic_dissipation_J", 1., 3),
      number_row("Dead load on the subgrade (N)", "dead_load_N", 1., 4),
      number_row("Peak force on the subgrade (N)", "subgrade_force_peak_N", 1.,
                 4),
      number_row("Impulse of the pulses (N s)", "pulse_impulse_Ns", 1., 4),
      text_row("Breakage events (–)", "n_events"),
      number_row("Energy residual / external work (%)",
                 "energy_residual_ratio_1", 100., 2),
      number_row("Non-conservative work / external work (%)",
                 "non_conservative_work_ratio_1", 100., 2),
      number_row("Largest overlap / radius (–)", "overlap_over_radius_1", 1.,
                 2),
      {"Exchange gain / limit (–)",
       [](const RunData &run)
       {
         return number_of(run.summary, "exchange_gain_1", 1., 2) + " / " +
                number_of(run.summary, "exchange_gain_limit_1", 1., 2);
       }},
      number_row("Largest exchange gain of the run (–)", "worst_gain_1", 1., 2),
      number_row("Time step (µs)", "time_step_s", 1e6),
      text_row("Steps (–)", "n_steps"),
      text_row("Threads (–)", "threads"),
      text_row("Version of Spall", "version")};
}

std::string cell(const std::string &text)
{
  return "<td>" + escape(text) + "</td>";
}

std::string head(std::span<const RunData> runs, const std::string &first)
{
  std::string out = "<thead><tr><th scope=\"col\">" + first + "</th>";
  for (const RunData &run : runs)
    out += "<th scope=\"col\">" + escape(run.name) + "</th>";
  return out + "</tr></thead>\n";
}

std::string row_head(const std::string &text)
{
  return "<tr><th scope=\"row\">" + escape(text) + "</th>";
}

/// Phases of all runs in the order of their appearance, without the total.
std::vector<std::string> phases_of(std::span<const RunData> runs)
{
  std::vector<std::string> phases;
  for (const RunData &run : runs)
    if (const auto clock = run.summary.find("wall_clock_s");
        clock != run.summary.end() && clock->is_object())
      for (const auto &[phase, seconds] : clock->items())
        if (phase != "total" &&
            std::find(phases.begin(), phases.end(), phase) == phases.end())
          phases.push_back(phase);
  return phases;
}

/// [s]; NaN if the run does not say.
double seconds(const RunData &run, const std::string &phase)
{
  const auto clock = run.summary.find("wall_clock_s");
  return clock != run.summary.end() && clock->is_object()
             ? number(*clock, phase)
             : std::numeric_limits<double>::quiet_NaN();
}

std::string time_cell(const RunData &run, const std::string &phase)
{
  const double time = seconds(run, phase), total = seconds(run, "total");
  if (!std::isfinite(time))
    return cell("–");
  const std::string share =
      total > 0. ? " (" + format_fixed(100. * time / total, 1) + " %)" : "";
  return cell(format_fixed(time, 1) + " s" + share);
}
} // namespace

std::string headline(std::span<const RunData> runs)
{
  std::string out;
  if (runs.size() == 1)
  {
    out = "<dl class=\"headline\">\n";
    for (const Headline &line : headlines_of(runs))
      out += "<div><dt>" + std::string(line.name) + "</dt><dd>" +
             headline_value(line, runs[0]) + "</dd></div>\n";
    return out + "</dl>\n";
  }
  out = "<div class=\"wide\"><table class=\"headline\">" + head(runs, "Run") +
        "<tbody>\n";
  for (const Headline &line : headlines_of(runs))
  {
    out += row_head(line.name);
    for (const RunData &run : runs)
      out += cell(headline_value(line, run));
    out += "</tr>\n";
  }
  return out + "</tbody></table></div>\n";
}

std::string summary_table(std::span<const RunData> runs)
{
  std::string out = "<div class=\"wide\"><table>";
  out += (runs.size() > 1 ? head(runs, "Run") : "") + "<tbody>\n";
  for (const Row &row : summary_rows())
  {
    std::string cells;
    bool has_value = false;
    for (const RunData &run : runs)
    {
      const std::string value = row.value(run);
      has_value =
          has_value || (value != "–" && value != "– / –" && value != "– → –");
      cells += cell(value);
    }
    // A rigid run has no membrane to speak of.
    if (has_value)
      out += row_head(row.name) + cells + "</tr>\n";
  }
  return out + "</tbody></table></div>\n";
}

std::string wall_clock(std::span<const RunData> runs)
{
  const std::vector<std::string> phases = phases_of(runs);
  if (phases.empty())
    return "<p>No times: summary.json has no wall_clock_s.</p>\n";
  ShareBar bar{{}, phases, {}};
  for (const RunData &run : runs)
  {
    bar.rows.push_back(run.name);
    bar.values.emplace_back();
    for (const std::string &phase : phases)
      bar.values.back().push_back(seconds(run, phase));
  }
  std::string out = "<figure>\n" + draw(bar) +
                    "</figure>\n<div class=\"wide\"><table>" +
                    head(runs, "Phase") + "<tbody>\n";
  for (std::size_t k = 0; k < phases.size(); ++k)
  {
    out += "<tr><th scope=\"row\"><span class=\"key\" style=\"background:" +
           palette_colour(k) + "\"></span>" + escape(phases[k]) + "</th>";
    for (const RunData &run : runs)
      out += time_cell(run, phases[k]);
    out += "</tr>\n";
  }
  out += "</tbody><tfoot>" + row_head("total");
  for (const RunData &run : runs)
    out += time_cell(run, "total");
  return out + "</tr></tfoot></table></div>\n";
}
} // namespace spall
