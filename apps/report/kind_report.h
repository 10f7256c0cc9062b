#pragma once

#include "report/chart.h"
#include "report/run_data.h"
#include "report/section.h"

#include <functional>
#include <span>
#include <string>
#include <vector>

namespace spall
{
/// A number at the top of a report.
struct Headline
{
  std::string name, unit; ///< unit with a blank before it
  std::function<double(const RunData &)> value;
  bool has_sign = false; ///< a change: show + as well
  bool is_count = false; ///< a whole number: show all its digits
};

/// A row of the table of a section; a row without any value is left out.
struct SummaryRow
{
  ReportSection section;
  std::string name;
  std::function<std::string(const RunData &)> value;
};

/// What the report of a run shows because of its kind.
struct KindReport
{
  std::vector<Headline> headlines;
  std::vector<SummaryRow> rows; ///< besides those of every kind
  /// The charts of one run, or of several in the same axes. A chart without
  /// curves lists in its notes what was missing.
  std::vector<Chart> (*charts)(std::span<const RunData> runs);
};

/// Of the kind of the first run.
const KindReport &report_of(std::span<const RunData> runs);

/// Last value of a column of the loading, or NaN.
double last(const RunData &run, const std::string &column);
/// From the summary, or the last value of the column of a run without one; NaN
/// without either.
double number_or_last(const RunData &run, const std::string &key,
                      const std::string &column);
double abrasion_percent(const RunData &run);

/// An entry of the summary as text.
std::string text_of(const nlohmann::ordered_json &summary,
                    const std::string &key);
/// A number of the summary as text.
std::string number_text_of(const nlohmann::ordered_json &summary,
                           const std::string &key, double factor = 1.,
                           int n_digits = 3);
/// Two numbers of the summary in one cell.
std::string number_pair(const nlohmann::ordered_json &summary,
                        const std::string &one, const std::string &other,
                        double factor);

/// Rows of one entry of the summary.
SummaryRow text_row(ReportSection section, const std::string &name,
                    const std::string &key);
SummaryRow number_row(ReportSection section, const std::string &name,
                      const std::string &key, double factor = 1.,
                      int n_digits = 3);
} // namespace spall
