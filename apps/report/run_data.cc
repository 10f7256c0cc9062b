#include "report/run_data.h"

#include "errors.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <limits>
#include <map>
#include <sstream>
#include <utility>

namespace spall
{
namespace
{
namespace fs = std::filesystem;

/// Columns and keys of the summary in files of earlier releases.
constexpr std::pair<const char *, const char *> old_columns[] = {
    {"shape_work_J", "non_conservative_work_J"},
    {"ball_radius_m", "equivalent_radius_m"},
    {"stone_velocity_peak_m_per_s", "particle_velocity_peak_m_per_s"},
    {"stone_velocity_rms_m_per_s", "particle_velocity_rms_m_per_s"},
    {"n_stones", "n_particles"},
};

std::vector<std::string> split(const std::string &line)
{
  std::vector<std::string> fields;
  std::istringstream in(line);
  for (std::string field; std::getline(in, field, ',');)
  {
    std::erase_if(field, [](char c) { return c == '\r' || c == ' '; });
    fields.push_back(field);
  }
  return fields;
}

/// False if a field is no number; nan and inf are numbers.
bool parse_row(const std::string &line, std::vector<double> &row)
{
  row.clear();
  for (const std::string &field : split(line))
  {
    char *end = nullptr;
    row.push_back(std::strtod(field.c_str(), &end));
    if (field.empty() || *end != '\0')
      return false;
  }
  return true;
}

std::string read_text(const fs::path &path)
{
  std::ostringstream text;
  text << std::ifstream(path).rdbuf();
  return text.str();
}

Table loading_rows(const Table &history)
{
  const std::vector<double> *stage = history.find("stage_1");
  if (!stage)
    return history;
  Table loading{history.names, {}, history.n_dropped};
  loading.columns.resize(history.columns.size());
  for (std::size_t row = 0; row < stage->size(); ++row)
    if ((*stage)[row] == 2.)
      for (std::size_t k = 0; k < loading.columns.size(); ++k)
        loading.columns[k].push_back(history.columns[k][row]);
  return loading;
}

void read_history(const fs::path &folder, RunData &run)
{
  const Table history = read_table((folder / "history.csv").string());
  run.loading = loading_rows(history);
  if (!history.find("stage_1") && history.find("cycle_1"))
    run.notes.push_back(
        "history.csv has no column stage_1: all its rows are shown.");
  if (run.loading.n_rows() == 0)
    run.notes.push_back("The loading had not begun: there are no curves.");
  if (history.n_dropped > 0)
    run.notes.push_back(std::to_string(history.n_dropped) +
                        " line(s) of history.csv do not fit its header and "
                        "were left out.");
}

void read_summary(const fs::path &folder, RunData &run)
{
  run.summary = nlohmann::ordered_json::object();
  if (!fs::exists(folder / "summary.json"))
  {
    run.notes.push_back("There is no summary.json (unfinished run?).");
    return;
  }
  const auto read = nlohmann::ordered_json::parse(
      read_text(folder / "summary.json"), nullptr, false);
  if (read.is_object())
    for (const auto &[key, value] : read.items())
    {
      const auto old = std::ranges::find(old_columns, key,
                                         [](const auto &names)
                                         { return std::string(names.first); });
      run.summary[old == std::end(old_columns) ? key : old->second] = value;
    }
  else
    run.notes.push_back("summary.json is not valid JSON and was left out.");
}

void read_if_there(const fs::path &path, Table &table)
{
  if (fs::exists(path))
    table = read_table(path.string());
}

void name_apart(std::vector<RunData> &runs)
{
  std::map<std::string, int> uses;
  for (const RunData &run : runs)
    ++uses[run.name];
  for (std::size_t k = 0; k < runs.size(); ++k)
    if (uses[runs[k].name] > 1)
      runs[k].name += " (" + std::to_string(k + 1) + ")";
}
} // namespace

const std::vector<double> *Table::find(const std::string &name) const
{
  const auto found = std::find(names.begin(), names.end(), name);
  return found == names.end() ? nullptr : &columns[found - names.begin()];
}

Table read_table(const std::string &path)
{
  std::ifstream in(path);
  std::string line;
  if (!std::getline(in, line) || line.empty())
    throw InputError(path + ": cannot be read or has no header line");
  Table table;
  table.names = split(line);
  for (const auto &[old, present] : old_columns)
    std::ranges::replace(table.names, std::string(old), std::string(present));
  table.columns.resize(table.names.size());
  for (std::vector<double> row; std::getline(in, line);)
  {
    if (!parse_row(line, row) || row.size() != table.names.size())
    {
      ++table.n_dropped;
      continue;
    }
    for (std::size_t k = 0; k < row.size(); ++k)
      table.columns[k].push_back(row[k]);
  }
  return table;
}

namespace
{
/// By its summary, or its case where there is none.
std::string kind_of(const RunData &run)
{
  if (const auto kind = run.summary.find("kind");
      kind != run.summary.end() && kind->is_string())
    return kind->get<std::string>();
  constexpr std::string_view key = "set kind = ";
  const std::size_t start = run.case_text.find(key);
  if (start == std::string::npos)
    return {};
  const std::size_t from = start + key.size();
  return run.case_text.substr(from, run.case_text.find('\n', from) - from);
}
} // namespace

RunData read_run(const std::string &folder)
{
  const fs::path path(folder);
  if (!fs::is_directory(path))
    throw InputError("report: '" + folder + "' is not a folder");
  if (!fs::exists(path / "history.csv"))
    throw InputError("report: '" + folder +
                     "' is not a run folder (it has no history.csv)");
  RunData run;
  run.folder = folder;
  // "runs/a/" and "." have names, too.
  run.name = fs::canonical(path).filename().string();
  read_history(path, run);
  read_summary(path, run);
  if (fs::exists(path / "events.csv"))
    run.events = read_table((path / "events.csv").string());
  else
    run.notes.push_back("There is no events.csv.");
  read_if_there(path / "cycles.csv", run.cycles);
  read_if_there(path / "boundary_profile_start.csv", run.profile_start);
  read_if_there(path / "boundary_profile_end.csv", run.profile_end);
  read_if_there(path / "sections_start.csv", run.sections_start);
  read_if_there(path / "sections_end.csv", run.sections_end);
  read_if_there(path / "gradation.csv", run.gradation);
  if (fs::exists(path / "case.prm"))
    run.case_text = read_text(path / "case.prm");
  else
    run.notes.push_back("There is no case.prm.");
  run.kind = kind_of(run);
  return run;
}

std::vector<RunData> read_runs(const std::vector<std::string> &folders)
{
  std::vector<RunData> runs;
  for (const std::string &folder : folders)
    runs.push_back(read_run(folder));
  name_apart(runs);
  return runs;
}

std::vector<std::size_t> cycle_ends(const Table &loading)
{
  const std::vector<double> *cycle = loading.find("cycle_1");
  if (!cycle || cycle->empty())
    return {};
  // A sample belongs to the end it was meant for, whatever its rounding.
  constexpr double slack = 5e-3;
  std::vector<std::size_t> rows{0};
  double next = 1.;
  for (std::size_t row = 0; row + 1 < cycle->size(); ++row)
    if ((*cycle)[row] <= next + slack && (*cycle)[row + 1] > next + slack)
    {
      rows.push_back(row);
      next = std::floor((*cycle)[row + 1] - slack) + 1.;
    }
  if (cycle->back() >= next - slack)
    rows.push_back(cycle->size() - 1);
  return rows;
}

double number(const nlohmann::ordered_json &summary, const std::string &key)
{
  const auto found = summary.find(key);
  if (found == summary.end() || !found->is_number())
    return std::numeric_limits<double>::quiet_NaN();
  return found->get<double>();
}
} // namespace spall
