#include "report/gradation_chart.h"

#include "report/figure_parts.h"

#include <algorithm>
#include <string>

namespace spall
{
bool have_gradation(std::span<const RunData> runs)
{
  return std::ranges::any_of(runs, [](const RunData &run)
                             { return run.gradation.n_rows() > 0; });
}

Chart gradation_chart(std::span<const RunData> runs)
{
  Chart chart{"gradation", ReportSection::specimen,
              "Gradation of the specimen (markers) and of the input table "
              "(line). The diameter of a particle is twice its mean radius.",
              "Diameter (mm)", "Mass passing (%)"};
  chart.has_log_x = true;
  for (std::size_t k = 0; k < runs.size(); ++k)
  {
    const Table &table = runs[k].gradation;
    const Column *diameter = table.find("diameter_m"),
                 *asked = table.find("asked_passing_1"),
                 *obtained = table.find("obtained_passing_1");
    if (!diameter || !asked || !obtained || diameter->empty())
    {
      chart.notes.push_back(runs[k].name + ": there is no gradation.csv.");
      continue;
    }
    Curve line = run_curve(runs, k);
    line.x = scaled(*diameter, 1e3);
    Curve markers = line;
    line.y = scaled(*asked, 100.);
    markers.y = scaled(*obtained, 100.);
    markers.line_width = 0.;
    markers.marker = Marker::dot;
    if (runs.size() == 1)
    {
      line.name = "asked";
      markers.name = "obtained";
      markers.colour = palette_colour(1);
    }
    else
    {
      markers.csv_name = markers.name + ", obtained";
      markers.name.clear();
    }
    chart.curves.push_back(line);
    chart.curves.push_back(markers);
  }
  return chart;
}
} // namespace spall
