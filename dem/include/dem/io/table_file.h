#pragma once

#include <dem/vector.h>

#include <cstdint>
#include <iosfwd>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace dem
{
/// A column of a table: n_components numbers, or one text, for each row.
struct TableColumn
{
  using Values =
      std::variant<std::vector<double>, std::vector<std::int64_t>,
                   std::vector<std::int32_t>, std::vector<std::string>>;

  std::string name;     ///< name_unit
  std::string unit;     ///< as text, "1" if none
  std::string sentence; ///< what it is
  Values values;        ///< row by row
  std::size_t n_components = 1;
};

/// Columns of equal length.
struct TableGroup
{
  std::string name;
  std::vector<TableColumn> columns;
};

/// Tables, and what holds for all of them by name.
struct TableFile
{
  using Attribute = std::variant<double, std::int64_t, std::string, Vec3>;

  std::vector<std::pair<std::string, Attribute>> attributes;
  std::vector<TableGroup> groups;
};

/// Version of the HDF5 library; empty if this build cannot write HDF5 (CMake
/// option SPALL_HDF5).
std::string hdf5_version();

/// Writes the tables as an HDF5 file: a group for each table, a dataset for
/// each column with the attributes `unit` and `sentence`. Numbers keep all
/// their bits, and equal tables make equal bytes. Throws std::runtime_error if
/// HDF5 fails, and where hdf5_version() is empty; the caller checks the stream.
void write_hdf5(std::ostream &out, const TableFile &tables);
} // namespace dem
