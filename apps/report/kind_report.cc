#include "report/kind_report.h"

#include "case/kind.h"
#include "report/text.h"

#include <cmath>
#include <limits>

namespace spall
{
const KindReport &report_of(std::span<const RunData> runs)
{
  const TestKind *kind = runs.empty() ? nullptr : find_kind(runs[0].kind);
  return (kind ? *kind : test_kinds().front()).report();
}

double last(const RunData &run, const std::string &column)
{
  const std::vector<double> *values = run.loading.find(column);
  return values && !values->empty() ? values->back()
                                    : std::numeric_limits<double>::quiet_NaN();
}

double number_or_last(const RunData &run, const std::string &key,
                      const std::string &column)
{
  const double value = number(run.summary, key);
  return std::isfinite(value) ? value : last(run, column);
}

double abrasion_percent(const RunData &run)
{
  return number_or_last(run, "laa_percent", "laa_percent");
}

std::string text_of(const nlohmann::ordered_json &summary,
                    const std::string &key)
{
  const auto found = summary.find(key);
  if (found == summary.end() || found->is_null())
    return "–";
  if (found->is_string())
    return found->get<std::string>();
  return found->is_number_integer() ? std::to_string(found->get<long>())
                                    : found->dump();
}

std::string number_text_of(const nlohmann::ordered_json &summary,
                           const std::string &key, double factor, int n_digits)
{
  return format(factor * number(summary, key), n_digits);
}

std::string number_pair(const nlohmann::ordered_json &summary,
                        const std::string &one, const std::string &other,
                        double factor)
{
  return number_text_of(summary, one, factor) + " / " +
         number_text_of(summary, other, factor);
}

SummaryRow text_row(ReportSection section, const std::string &name,
                    const std::string &key)
{
  return {section, name,
          [key](const RunData &run) { return text_of(run.summary, key); }};
}

SummaryRow number_row(ReportSection section, const std::string &name,
                      const std::string &key, double factor, int n_digits)
{
  return {section, name, [=](const RunData &run) {
            return number_text_of(run.summary, key, factor, n_digits);
          }};
}
} // namespace spall
