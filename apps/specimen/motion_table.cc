#include "specimen/motion_table.h"

#include "errors.h"
#include "specimen/csv_table.h"

namespace spall
{
MotionTable read_motion_table(const std::string &path)
{
  const std::string header = "time_s,x_m,y_m,z_m";
  const CsvTable csv = read_number_table(path, header);
  if (csv.rows.empty())
    throw InputError(path + ": has no rows, must be " + header +
                     " and one row for each time");
  MotionTable table;
  for (const CsvRow &row : csv.rows)
  {
    const std::vector<double> &v = row.numbers;
    if (v[0] < 0. || (!table.time.empty() && v[0] <= table.time.back()))
      row.refuse("times must be at least 0 and increase");
    table.time.push_back(v[0]);
    table.shift.emplace_back(v[1], v[2], v[3]);
    if (!table.shift.front().isZero(0.))
      row.refuse("the first displacement must be 0, 0, 0: a wall starts where "
                 "its mesh and position are");
  }
  return table;
}
} // namespace spall
