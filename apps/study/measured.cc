#include "study/measured.h"

#include "case/fields.h"
#include "case/parameter.h"
#include "errors.h"
#include "report/run_data.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>

namespace spall
{
namespace
{
/// Whether the column holds in this row the number of the text.
bool says(const std::vector<double> &column, std::size_t row,
          const std::string &value)
{
  constexpr double rounding = 1e-9;
  const double number = std::atof(value.c_str());
  return std::abs(column[row] - number) <= rounding * std::abs(number);
}

/// Columns of the table that are keys of the case, with the values of these.
std::map<std::string, std::string>
case_values(const Table &table, const Study &study, const StudyPoint &point)
{
  Case parameters = read_case(study.case_file, point.overrides);
  std::map<std::string, std::string> values;
  for (const Parameter &key : parameters_of(parameters))
    if (const std::string name = key.section + "/" + key.key; table.find(name))
      values[name] = value_text(key);
  return values;
}
} // namespace

MeasuredPoints measured_points(const StudyData &data, const Cut &cut,
                               const std::string &value)
{
  const Study &study = data.study;
  const auto of_sweep = std::ranges::find_if(
      data.points, [&](const StudyPoint &point)
      { return cut.takes(point) && is_beside_base(data, cut.key, point); });
  if (study.measured.empty() || of_sweep == data.points.end())
    return {};
  const Table table = read_table(study.measured);
  if (!table.find(study.keys[cut.key].name()))
    return {};
  auto values = case_values(table, study, *of_sweep);
  values[study.keys[cut.key].name()] = value;
  MeasuredPoints points;
  for (std::size_t row = 0; row < table.n_rows(); ++row)
  {
    if (!std::ranges::all_of(
            values, [&](const auto &key)
            { return says(*table.find(key.first), row, key.second); }))
      continue;
    points.x.push_back((*table.find(study.curve_x))[row]);
    points.y.push_back((*table.find(study.curve_y))[row]);
  }
  return points;
}

void check_measured(const Study &study)
{
  if (study.measured.empty())
    return;
  const Table table = read_table(study.measured);
  const bool has_key =
      std::ranges::any_of(study.keys, [&](const SweptKey &key)
                          { return table.find(key.name()) != nullptr; });
  if (!has_key || !table.find(study.curve_x) || !table.find(study.curve_y))
    throw InputError(study.file + ": Study/measured = " + study.measured +
                     ": must have columns named as those of Study/curve and as "
                     "a key of section Sweep");
}
} // namespace spall
