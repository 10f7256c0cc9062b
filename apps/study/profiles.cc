#include "study/profiles.h"

#include "report/run_data.h"
#include "run/quantity_name.h"
#include "study/levels.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace spall
{
namespace
{
namespace fs = std::filesystem;

/// Error bars of a curve, about: more would hide it.
constexpr std::size_t most_bars = 15;

/// Rows of the cases with one value of the key.
struct Rows
{
  std::size_t n_cases = 0;
  std::vector<std::vector<double>> x, y; ///< [row][case]; finite ones
};

void add_case(const fs::path &path, const Profile &profile, Rows &rows)
{
  if (!fs::exists(path))
    return;
  const Table table = read_table(path.string());
  const std::vector<double> *x = table.find(profile.x),
                            *y = table.find(profile.y);
  if (!x || !y)
    return;
  ++rows.n_cases;
  rows.x.resize(std::max(rows.x.size(), x->size()));
  rows.y.resize(rows.x.size());
  for (std::size_t row = 0; row < x->size(); ++row)
    if (std::isfinite((*x)[row]) && std::isfinite((*y)[row]))
    {
      rows.x[row].push_back((*x)[row]);
      rows.y[row].push_back((*y)[row]);
    }
}

Rows rows_of(const StudyData &data, std::size_t key, const std::string &value,
             const Profile &profile, const fs::path &folder)
{
  Rows rows;
  for (const std::size_t p : drawn_cases(data, key, value))
    add_case(folder / data.points[p].folder / profile.file, profile, rows);
  return rows;
}

/// Which of both is the outcome: a height goes up the page.
bool is_upright(const Profile &profile)
{
  return profile.y.starts_with("height");
}

/// Rows that one of the cases does not have are left out: they would be of
/// other specimens.
void add_level(const Rows &rows, const std::string &name, std::size_t index,
               bool is_upright, Chart &chart)
{
  Curve means, bars;
  means.name = name;
  means.colour = bars.colour = palette_colour(index);
  means.dash = palette_dash(index);
  if (index >= palette_size)
    means.line_width *= 2.;
  bars.line_width = 0.6;
  bars.csv_name = name + ", ends of the bars";
  const double gap = std::numeric_limits<double>::quiet_NaN();
  const std::size_t stride = (rows.x.size() + most_bars - 1) / most_bars;
  for (std::size_t row = 0; row < rows.x.size(); ++row)
  {
    if (rows.x[row].size() < rows.n_cases)
      continue;
    const double x = estimate_of(rows.x[row]).mean,
                 y = estimate_of(rows.y[row]).mean;
    means.x.push_back(x);
    means.y.push_back(y);
    if (row % stride != index % stride)
      continue;
    const double spread =
        standard_deviation(is_upright ? rows.x[row] : rows.y[row]);
    const double dx = is_upright ? spread : 0., dy = is_upright ? 0. : spread;
    bars.x.insert(bars.x.end(), {x - dx, x + dx, gap});
    bars.y.insert(bars.y.end(), {y - dy, y + dy, gap});
  }
  if (means.x.empty())
    return;
  chart.curves.push_back(bars);
  chart.curves.push_back(means);
}
} // namespace

Chart profile_chart(const StudyData &data, std::size_t key,
                    const Profile &profile, const fs::path &folder)
{
  const SweptKey &swept = data.study.keys[key];
  Chart chart{fs::path(profile.file).stem().string() + "_" +
                  (is_upright(profile) ? profile.x : profile.y) + "_" +
                  swept.id(),
              ReportSection::response,
              "Profile of " + quantity_name(profile.y).words + " over " +
                  quantity_name(profile.x).words + " (" + profile.file +
                  ") for the values of " + swept.name() +
                  ": means of the cases and bars of one standard deviation "
                  "up and down.",
              axis_label(profile.x), axis_label(profile.y)};
  std::size_t index = 0;
  for (const Level &level : levels_of(data, Cut(key), 0))
    add_level(rows_of(data, key, level.value, profile, folder),
              swept.with_unit(level.value), index++, is_upright(profile),
              chart);
  if (chart.curves.empty())
    chart.notes.push_back("no case of this sweep has " + profile.file +
                          " with " + profile.x + " and " + profile.y + ".");
  return chart;
}
} // namespace spall
