#pragma once

#include "report/chart.h"

#include <cstddef>
#include <string>

namespace spall
{
/// The numbers of a figure as CSV: what is drawn, in the units of its axes.
struct ChartTable
{
  std::string csv;          ///< one header line, columns name_unit
  std::size_t n_rows = 0;   ///< points in the table
  std::size_t n_points = 0; ///< points of the curves, with those not drawn
};

/// A row for each drawn point; with several curves, their names are the first
/// column. Six significant digits.
ChartTable table_of(const Chart &chart);

/// "Axial strain (%)" is axial_strain_percent.
std::string column_name(const std::string &label);

/// A cell of a CSV file, in quotes where it needs them.
std::string csv_cell(const std::string &text);

/// Six significant digits.
std::string csv_number(double value);
} // namespace spall
