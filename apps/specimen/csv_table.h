#pragma once

#include <string>
#include <vector>

namespace spall
{
/// One row of a CSV file.
struct CsvRow
{
  std::string text;               ///< as it stands, for messages
  std::string location;           ///< "file.csv:12"
  std::vector<std::string> cells; ///< without blanks round them
};

/// A CSV file: a header and rows of as many cells. Empty lines are left out,
/// and so are lines that begin with #, which are comments.
struct CsvTable
{
  CsvRow header;
  std::vector<CsvRow> rows, comments;

  /// Column of this name; -1: there is none.
  int column(const std::string &name) const;
};

/// Reads a file, plain or compressed by gzip. `header` says in messages what
/// the first line must be. Throws InputError with file, line and what is
/// allowed: missing, unreadable or without a header, a row of another length.
CsvTable read_csv(const std::string &path, const std::string &header);

/// The cells of a row of numbers. Throws InputError.
std::vector<double> numbers_of(const CsvRow &row, const std::string &header);
} // namespace spall
