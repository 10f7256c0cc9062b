#pragma once

#include <string>
#include <vector>

namespace spall::verify
{
/// A table of data/reference: CSV, one header line, a name in the first column
/// and numbers in the others.
class ReferenceTable
{
public:
  /// Sought in the folder SPALL_DATA_DIR, then in the data of the source tree.
  /// Throws InputError: missing file, a row that does not fit the header.
  explicit ReferenceTable(const std::string &file);

  std::size_t size() const { return names.size(); }
  const std::string &name(std::size_t row) const { return names[row]; }
  /// Throws InputError if there is no such column.
  double value(std::size_t row, const std::string &column) const;

private:
  std::string path;
  std::vector<std::string> headings; ///< without the first
  std::vector<std::string> names;
  std::vector<std::vector<double>> rows;
};
} // namespace spall::verify
