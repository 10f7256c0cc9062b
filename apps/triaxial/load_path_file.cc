// A loading path from a CSV file: one row a stage.
#include "case/case.h"
#include "case/file.h"
#include "case/parameter.h"
#include "errors.h"
#include "specimen/csv_table.h"
#include "triaxial/load_path.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <stdexcept>
#include <utility>

namespace spall
{
namespace
{
constexpr std::size_t most_stages = 10000;
constexpr double most_cycles = 1e7; ///< of all stages together
constexpr Range stress_range = between(0., 1e9),
                strain_range = between(-0.9, 0.9);

/// A row of the file: its filled cells by column.
struct Row
{
  std::string location; ///< "path.csv:3"
  std::map<std::string, std::string> cells;

  bool has(const std::string &column) const { return cells.contains(column); }
  const std::string &text(const std::string &column) const
  {
    return cells.at(column);
  }
  [[noreturn]] void refuse(const std::string &column,
                           const std::string &allowed) const
  {
    throw InputError(location + ": " + column + " = " +
                     (has(column) ? text(column) : "(empty)") + ": " + allowed);
  }
  void assign_cell(const std::string &column, decltype(Parameter::value) value,
                   const Range &range = {}) const
  {
    Parameter described;
    described.value = std::move(value);
    described.range = range;
    try
    {
      assign(described, text(column));
    }
    catch (const std::invalid_argument &error)
    {
      refuse(column, error.what());
    }
  }
  double number(const std::string &column, const Range &range) const
  {
    double value = 0.;
    assign_cell(column, &value, range);
    return value;
  }
  std::optional<double> optional(const std::string &column,
                                 const Range &range) const
  {
    return has(column) ? std::optional(number(column, range)) : std::nullopt;
  }
  /// Index of the cell among these names.
  std::size_t choice(const std::string &column,
                     const std::vector<std::string> &names) const
  {
    const auto found = std::ranges::find(names, text(column));
    if (found != names.end())
      return static_cast<std::size_t>(found - names.begin());
    std::string all;
    for (const std::string &name : names)
      all += (all.empty() ? "must be one of " : ", ") + name;
    refuse(column, all);
  }
  /// Refuses these columns where they are filled.
  void refuse_all(const std::vector<std::string> &columns,
                  const std::string &why) const
  {
    for (const std::string &column : columns)
      if (has(column))
        refuse(column, why);
  }
};

std::vector<std::string> columns_of(const std::string &direction)
{
  return {direction + "_stress_Pa", direction + "_stress_rate_Pa_per_s",
          direction + "_strain_1", direction + "_strain_rate_1_per_s"};
}

const std::vector<std::string> &known_columns()
{
  static const std::vector<std::string> all = []
  {
    std::vector<std::string> names = {"name"};
    for (const char *direction : {"axial", "lateral", "x", "y"})
      for (const std::string &column : columns_of(direction))
        names.push_back(column);
    for (const char *column :
         {"lateral_rule", "dq_over_dp_1", "lateral_over_axial_1", "duration_s",
          "wave", "wave_file", "amplitude_Pa", "lateral_amplitude_Pa",
          "frequency_Hz", "rest_s", "cycles_1", "section",
          "until_axial_strain_1", "until_stress_ratio_1",
          "until_unbalanced_force_ratio_1"})
      names.emplace_back(column);
    return names;
  }();
  return all;
}

LoadDirection read_direction(const Row &row, const std::string &direction)
{
  const std::vector<std::string> columns = columns_of(direction);
  const bool has_stress = row.has(columns[0]) || row.has(columns[1]),
             has_strain = row.has(columns[2]) || row.has(columns[3]);
  if (has_stress && has_strain)
    row.refuse(row.has(columns[2]) ? columns[2] : columns[3],
               "must be empty beside a stress of the same direction");
  if (has_stress)
    return {LoadControl::stress, row.optional(columns[0], stress_range),
            row.optional(columns[1], between(-1e15, 1e15))};
  if (has_strain)
    return {LoadControl::strain, row.optional(columns[2], strain_range),
            row.optional(columns[3], between(-1e4, 1e4))};
  return {};
}

void read_sides(const Row &row, LoadStage &stage)
{
  stage.sides.fill(read_direction(row, "lateral"));
  for (std::size_t d = 0; d < 2; ++d)
    if (const LoadDirection own = read_direction(row, d == 0 ? "x" : "y");
        own.control != LoadControl::keep)
      stage.sides[d] = own;
}

/// d(lateral) / d(axial) of a stress path with this slope: q = axial less
/// lateral, p = (axial + 2 lateral) / 3.
double side_ratio_of_slope(double dq_over_dp)
{
  return (3. - dq_over_dp) / (3. + 2. * dq_over_dp);
}

void read_rule(const Row &row, LoadStage &stage)
{
  const std::vector<std::string> rules = {"lateral_rule", "dq_over_dp_1",
                                          "lateral_over_axial_1"};
  const auto first = std::ranges::find_if(rules, [&](const std::string &column)
                                          { return row.has(column); });
  if (first == rules.end())
    return;
  for (auto other = first + 1; other != rules.end(); ++other)
    if (row.has(*other))
      row.refuse(*other, "must be empty beside " + *first);
  for (const char *direction : {"lateral", "x", "y"})
    row.refuse_all(columns_of(direction), "must be empty beside " + *first);
  row.refuse_all({"lateral_amplitude_Pa"}, "must be empty beside " + *first);
  stage.rule = SideRule::proportional;
  if (*first == rules[1])
    stage.side_ratio =
        side_ratio_of_slope(row.number(*first, above(-1.5, 1e6)));
  else if (*first == rules[2])
    stage.side_ratio = row.number(*first, between(-10., 10.));
  else if (row.choice(*first, {"constant_p", "constant_volume"}) == 0)
    stage.side_ratio = -0.5;
  else
    stage.rule = SideRule::constant_volume;
}

WaveTable table_of(const Row &row, const Case &c)
{
  if (!row.has("wave_file"))
    row.refuse("wave_file", "must be a CSV file share_1,value_1 with wave = "
                            "table");
  try
  {
    return read_wave_table(
        find_path(c, "Loading", "path", row.text("wave_file")));
  }
  catch (const InputError &error)
  {
    row.refuse("wave_file", error.what());
  }
}

void read_wave(const Row &row, const Case &c, LoadStage &stage)
{
  const std::vector<std::string> only_of_waves = {
      "wave_file",    "amplitude_Pa", "lateral_amplitude_Pa",
      "frequency_Hz", "rest_s",       "cycles_1"};
  if (!row.has("wave"))
    return row.refuse_all(only_of_waves, "must be empty without a wave");
  row.refuse_all({"duration_s"},
                 "must be empty beside a wave: frequency_Hz, rest_s and "
                 "cycles_1 give it");
  for (const char *column : {"frequency_Hz", "cycles_1", "amplitude_Pa"})
    if (!row.has(column))
      row.refuse(column, "must be set beside a wave");
  stage.wave.form = static_cast<WaveForm>(row.choice("wave", wave_names()) + 1);
  stage.wave.frequency = row.number("frequency_Hz", above(0., 1e4));
  stage.wave.rest = row.optional("rest_s", between(0., 1e6)).value_or(0.);
  stage.amplitude = row.number("amplitude_Pa", between(-1e9, 1e9));
  stage.side_amplitude =
      row.optional("lateral_amplitude_Pa", between(-1e9, 1e9)).value_or(0.);
  const double cycles = row.number("cycles_1", between(1., 1e7));
  if (cycles != std::floor(cycles))
    row.refuse("cycles_1", "must be a whole number");
  stage.cycles = static_cast<int>(cycles);
  if (stage.wave.form == WaveForm::table)
    stage.wave.table = table_of(row, c);
  else
    row.refuse_all({"wave_file"}, "must be empty unless wave = table");
}

/// What gives a stage its length, and each direction its rate.
void check_length(const Row &row, const LoadStage &stage)
{
  bool has_length = stage.has_wave() || stage.duration > 0.;
  for (const auto &[name, direction] :
       {std::pair("axial", stage.axial), std::pair("x", stage.sides[0]),
        std::pair("y", stage.sides[1])})
  {
    if (!direction.has_own_length())
      continue;
    const std::string rate =
        std::string(name) + (direction.control == LoadControl::stress
                                 ? "_stress_rate_Pa_per_s"
                                 : "_strain_rate_1_per_s");
    const std::string column =
        row.has(rate) ? rate : "lateral" + rate.substr(1);
    if (stage.has_wave() || stage.duration > 0.)
      row.refuse(column, "must be empty where the stage has a target and a "
                         "length");
    if (*direction.rate == 0.)
      row.refuse(column, "must not be 0 where the target gives the length");
    has_length = true;
  }
  if (!has_length)
    row.refuse("duration_s", "must be set unless the stage has a wave, or "
                             "target and rate of one direction");
}

LoadStage read_stage(const Row &row, const Case &c)
{
  LoadStage stage;
  if (row.has("name"))
    row.assign_cell("name", &stage.name);
  stage.axial = read_direction(row, "axial");
  read_sides(row, stage);
  read_rule(row, stage);
  read_wave(row, c, stage);
  stage.duration = row.optional("duration_s", above(0., 1e6)).value_or(0.);
  if (row.has("section"))
    stage.is_over_first_section =
        row.choice("section", {"present", "first"}) == 1;
  stage.until_strain = row.optional("until_axial_strain_1", strain_range);
  stage.until_ratio = row.optional("until_stress_ratio_1", between(-1.5, 3.));
  stage.until_unbalanced =
      row.optional("until_unbalanced_force_ratio_1", above(0., 1.));
  check_length(row, stage);
  return stage;
}

/// What the stage before has to do with it, and the boundary of the sides.
void check_in_order(const Row &row, const Case &c, bool &is_driven,
                    const LoadStage &stage)
{
  if (stage.axial.control != LoadControl::keep)
    is_driven = stage.axial.control == LoadControl::strain;
  if (stage.has_wave() && is_driven)
    row.refuse("wave", "must be empty while the plate is driven: a wave is "
                       "one of axial stress, so axial_stress_Pa must be set");
  const bool is_membrane = c.boundary.lateral == Lateral::membrane;
  const bool is_cylinder = c.specimen.form == SpecimenForm::cylinder;
  if (is_membrane || is_cylinder)
    for (const char *direction : {"x", "y"})
      row.refuse_all(columns_of(direction),
                     "must be empty unless the specimen is a box between "
                     "rigid sides: use lateral");
  if (!is_membrane)
    return;
  row.refuse_all({"lateral_strain_1", "lateral_strain_rate_1_per_s"},
                 "must be empty with Boundary/lateral = membrane, which has a "
                 "pressure: use rigid");
  if (stage.rule == SideRule::constant_volume)
    row.refuse("lateral_rule", "must not be constant_volume with "
                               "Boundary/lateral = membrane: use rigid");
}

void check_header(const CsvRow &header)
{
  std::set<std::string> names;
  for (const std::string &column : header.cells)
  {
    if (std::ranges::find(known_columns(), column) == known_columns().end())
    {
      const std::string near = nearest(column, known_columns());
      throw InputError(header.location + ": \"" + column +
                       "\": no column of a loading path has this name" +
                       (near.empty() ? "" : ", did you mean " + near + "?"));
    }
    if (!names.insert(column).second)
      throw InputError(header.location + ": \"" + column +
                       "\": a column must appear once");
  }
}

Row row_of(const CsvRow &line, const CsvRow &header)
{
  Row row{line.location, {}};
  for (std::size_t k = 0; k < line.cells.size(); ++k)
    if (!line.cells[k].empty())
      row.cells[header.cells[k]] = line.cells[k];
  return row;
}
} // namespace

LoadPath read_load_path(const std::string &file, const Case &c)
{
  const CsvTable table =
      read_csv(file, "columns of a loading path, such as "
                     "name,axial_stress_Pa,duration_s, and below it at least "
                     "one stage");
  check_header(table.header);
  LoadPath path;
  bool is_driven = false;
  double n_cycles = 0.;
  for (const CsvRow &line : table.rows)
  {
    const Row row = row_of(line, table.header);
    LoadStage stage = read_stage(row, c);
    check_in_order(row, c, is_driven, stage);
    if (stage.name.empty())
      stage.name = "stage " + std::to_string(path.stages.size() + 1);
    n_cycles += stage.n_cycles();
    if (n_cycles > most_cycles)
      row.refuse("cycles_1", "all stages must have at most " +
                                 number_text(most_cycles) + " cycles");
    path.stages.push_back(std::move(stage));
    if (path.stages.size() > most_stages)
      throw InputError(row.location + ": a loading path must have at most " +
                       std::to_string(most_stages) + " stages");
  }
  if (path.stages.empty())
    throw InputError(file + ": a loading path needs a header and at least one "
                            "stage");
  return path;
}
} // namespace spall
