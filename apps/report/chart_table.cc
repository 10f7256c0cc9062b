#include "report/chart_table.h"

#include "report/chart_frame.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstdio>
#include <utility>

namespace spall
{
namespace
{
/// Characters of labels as the names of columns have them.
constexpr std::array<std::pair<const char *, const char *>, 9> spellings = {
    {{"–", "1"},
     {"%", "percent"},
     {"²", "2"},
     {"³", "3"},
     {"µ", "u"},
     {" per ", "_per_"},
     {"/", "_per_"},
     {"^", ""},
     {"·", ""}}};

std::string spelled(std::string text)
{
  for (const auto &[from, to] : spellings)
    for (std::size_t at = text.find(from); at != std::string::npos;
         at = text.find(from, at))
      text.replace(at, std::string(from).size(), to);
  return text;
}

/// Words joined by one underscore each.
std::string joined_words(const std::string &text)
{
  std::string name;
  for (const unsigned char c : text)
    if (std::isalnum(c) != 0)
      name += static_cast<char>(c);
    else if (!name.empty() && name.back() != '_')
      name += '_';
  if (name.ends_with('_'))
    name.pop_back();
  return name;
}

std::string lower_case(std::string text)
{
  for (char &c : text)
    c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

std::vector<std::size_t> drawn_rows(const Curve &curve, const Frame &frame)
{
  if (curve.marker != Marker::none)
    return frame.finite_rows(curve);
  std::vector<std::size_t> rows;
  for (const LinePoint &point : frame.line_points(curve))
    rows.push_back(point.row);
  return rows;
}

std::string abscissa(const Chart &chart, double x)
{
  if (chart.x_names.empty())
    return csv_number(x);
  const long last = static_cast<long>(chart.x_names.size()) - 1;
  return csv_cell(chart.x_names[static_cast<std::size_t>(
      std::clamp(std::lround(x) - 1, 0L, last))]);
}
} // namespace

std::string column_name(const std::string &label)
{
  const std::size_t open = label.rfind(" ("), close = label.rfind(')');
  const bool has_unit = open != std::string::npos &&
                        close != std::string::npos && open + 2 < close;
  const std::string words = has_unit ? label.substr(0, open) : label;
  std::string name = lower_case(joined_words(spelled(words)));
  if (has_unit)
  {
    std::string unit = spelled(label.substr(open + 2, close - open - 2));
    std::erase(unit, ' ');
    name += "_" + joined_words(unit);
  }
  return name;
}

std::string csv_cell(const std::string &text)
{
  if (text.find_first_of(",\"\n") == std::string::npos)
    return text;
  std::string quoted = "\"";
  for (const char c : text)
    quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + "\"";
}

std::string csv_number(double value)
{
  char text[32];
  std::snprintf(text, sizeof text, "%.8g", value);
  return text;
}

ChartTable table_of(const Chart &chart)
{
  const Frame frame(chart);
  const auto n_curves = std::ranges::count_if(
      chart.curves, [](const Curve &curve) { return curve.is_in_csv; });
  const bool has_names = n_curves > 1;
  ChartTable table;
  table.csv = std::string(has_names ? "curve," : "") +
              column_name(chart.x_label) + "," + column_name(chart.y_label) +
              "\n";
  for (const Curve &curve : chart.curves)
  {
    if (!curve.is_in_csv)
      continue;
    table.n_points += frame.finite_rows(curve).size();
    const std::string name =
        has_names
            ? csv_cell(curve.csv_name.empty() ? curve.name : curve.csv_name) +
                  ","
            : "";
    for (const std::size_t row : drawn_rows(curve, frame))
    {
      table.csv += name + abscissa(chart, curve.x[row]) + "," +
                   csv_number(curve.y[row]) + "\n";
      ++table.n_rows;
    }
  }
  return table;
}
} // namespace spall
