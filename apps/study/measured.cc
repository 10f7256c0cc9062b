#include "study/measured.h"

#include "errors.h"
#include "report/run_data.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace spall
{
namespace
{
/// Whether the column holds in this row what the text says, as a number.
bool says(const std::vector<double> &column, std::size_t row,
          const std::string &value)
{
  constexpr double rounding = 1e-9;
  const double number = std::atof(value.c_str());
  return std::abs(column[row] - number) <= rounding * std::abs(number);
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
  MeasuredPoints points;
  for (std::size_t row = 0; row < table.n_rows(); ++row)
  {
    bool is_of_it = true;
    for (std::size_t k = 0; k < study.keys.size(); ++k)
      if (const auto *column = table.find(study.keys[k].name()))
        is_of_it = is_of_it && says(*column, row,
                                    k == cut.key ? value : of_sweep->values[k]);
    if (!is_of_it)
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
