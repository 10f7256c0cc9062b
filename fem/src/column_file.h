#pragma once

#include <string>
#include <vector>

namespace fem
{
/// Two columns of a CSV file.
struct ColumnPair
{
  std::vector<double> first, second;
};

/// Reads a file that begins with this header ("time_s,force_N") and has two
/// finite numbers in every further line, the first ascending from 0. Blank
/// lines are skipped. Throws std::invalid_argument with file and line.
ColumnPair read_columns(const std::string &path, const std::string &header);
} // namespace fem
