#include "report/figure_element.h"

#include "report/chart_table.h"
#include "report/text.h"

#include <cctype>
#include <cstring>

namespace spall
{
namespace
{
/// As an address has it; digits, commas and dots stay readable.
std::string percent_encoded(const std::string &text)
{
  static const char digits[] = "0123456789ABCDEF";
  std::string out;
  out.reserve(text.size() + text.size() / 8);
  for (const char c : text)
  {
    const auto byte = static_cast<unsigned char>(c);
    if (byte < 128 &&
        (std::isalnum(byte) != 0 || std::strchr(",.-_~", c) != nullptr))
      out += c;
    else
      out += {'%', digits[byte >> 4], digits[byte & 15]};
  }
  return out;
}

/// A label inside a sentence: "axial strain (%)"; without the unit of a number.
std::string in_sentence(std::string label)
{
  const std::string no_unit = " (–)";
  if (label.ends_with(no_unit))
    label.erase(label.size() - no_unit.size());
  const auto is_capital = [&](std::size_t k)
  {
    return k < label.size() &&
           std::isupper(static_cast<unsigned char>(label[k])) != 0;
  };
  if (is_capital(0) && !is_capital(1))
    label[0] =
        static_cast<char>(std::tolower(static_cast<unsigned char>(label[0])));
  return label;
}

/// What is plotted against what, in which units.
std::string axes_text(const Chart &chart)
{
  return " Plotted: " + in_sentence(chart.y_label) + " against " +
         in_sentence(chart.x_label) + ".";
}

/// Which points the figure leaves out, if it does.
std::string omitted_text(const ChartTable &table)
{
  if (table.n_rows >= table.n_points)
    return "";
  return " Figure and CSV hold " + std::to_string(table.n_rows) + " of " +
         std::to_string(table.n_points) +
         " points: those closer than a third of a pixel are omitted.";
}
} // namespace

std::string csv_link(const std::string &file, const std::string &csv)
{
  return "<p class=\"csv\"><a download=\"" + escape(file) +
         "\" href=\"data:text/csv;charset=utf-8," + percent_encoded(csv) +
         "\">Numbers of the figure (" + escape(file) + ")</a></p>\n";
}

std::string html_notes(const std::vector<std::string> &lines)
{
  std::string out;
  for (const std::string &line : lines)
    out += "<p class=\"note\">" + escape(line) + "</p>\n";
  return out;
}

std::string html_figure(const Chart &chart)
{
  const ChartTable table = table_of(chart);
  return "<figure id=\"" + escape(chart.id) + "\">\n" + draw(chart) +
         "<figcaption>" +
         escape(chart.caption + axes_text(chart) + omitted_text(table)) +
         "</figcaption>\n" + csv_link(chart.id + ".csv", table.csv) +
         html_notes(chart.notes) + "</figure>\n";
}
} // namespace spall
