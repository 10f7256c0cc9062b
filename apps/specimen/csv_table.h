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
  std::vector<double> numbers;    ///< the same, see read_number_table()

  /// Throws InputError: location, text and what is allowed.
  [[noreturn]] void refuse(const std::string &allowed) const;
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

/// The same of a file of numbers with exactly this header.
CsvTable read_number_table(const std::string &path, const std::string &header);

/// Two columns of numbers under this header, the first ascending from 0; a row
/// or more. Throws InputError.
struct ColumnPair
{
  std::vector<double> first, second;
};
ColumnPair read_ascending(const std::string &path, const std::string &header);
} // namespace spall
