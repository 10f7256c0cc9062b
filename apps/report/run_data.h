#pragma once

#include <nlohmann/json.hpp>

#include <string>
#include <vector>

namespace spall
{
/// Columns of a CSV file with one header line, found by name.
struct Table
{
  std::vector<std::string> names;
  std::vector<std::vector<double>> columns; ///< one per name, equally long
  std::size_t n_dropped = 0; ///< lines that did not fit the header

  /// Null if there is no such column.
  const std::vector<double> *find(const std::string &name) const;
  std::size_t n_rows() const { return columns.empty() ? 0 : columns[0].size(); }
};

/// Data of one run in a report. Only history.csv has to be there.
struct RunData
{
  std::string folder;
  std::string name;                   ///< short, unlike that of the other runs
  std::string kind;                   ///< of test, by name; empty: not known
  Table loading;                      ///< rows of history.csv with stage_1 = 2
  Table events;                       ///< empty without events.csv
  Table cycles;                       ///< empty without cycles.csv
  Table profile_start, profile_end;   ///< empty without boundary_profile_*.csv
  Table sections_start, sections_end; ///< empty without sections_*.csv
  Table gradation;                    ///< empty without gradation.csv
  nlohmann::ordered_json summary;     ///< an empty object without summary.json
  std::string case_text;              ///< empty without case.prm
  std::vector<std::string> notes;     ///< what is missing or odd, one line each
};

/// Throws InputError if the file cannot be read or has no header line.
Table read_table(const std::string &path);

/// Throws InputError unless the folder holds a history.csv.
RunData read_run(const std::string &folder);

/// Several runs with distinct names.
std::vector<RunData> read_runs(const std::vector<std::string> &folders);

/// Rows of the ends of cycles 1, 2, ... (as far as the run went), after row 0,
/// the start of loading. Empty without rows or without a column cycle_1.
std::vector<std::size_t> cycle_ends(const Table &loading);

/// summary["a"]["b"] as a number; NaN if absent or not a number.
double number(const nlohmann::ordered_json &summary, const std::string &key);
} // namespace spall
