#pragma once

#include "specimen/csv_table.h"

namespace spall
{
/// Reads a table of particles as JSON: an array of objects whose keys are the
/// columns, all objects with the same keys and with numbers or texts as values,
/// or an object with this array as `particles` and three numbers as `box`. The
/// result is that of a CSV file with these columns. Throws InputError with the
/// file, the number of the particle and what is allowed.
CsvTable read_json_table(const std::string &path);
} // namespace spall
