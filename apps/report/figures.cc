#include "report/figures.h"

#include "report/gradation_chart.h"
#include "report/kind_report.h"

namespace spall
{
std::vector<Chart> make_charts(std::span<const RunData> runs)
{
  std::vector<Chart> charts = report_of(runs).charts(runs);
  if (have_gradation(runs))
    charts.push_back(gradation_chart(runs));
  return charts;
}
} // namespace spall
