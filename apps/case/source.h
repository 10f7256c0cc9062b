#pragma once

#include <istream>
#include <string>
#include <vector>

namespace spall
{
/// One `set key = value` of a case, with its location.
struct Assignment
{
  std::string section, key, value;
  std::string location; ///< "case.prm:12", "case.json" or "--set"
};

/// Past the three bytes that some editors put before the first line.
void skip_byte_order_mark(std::istream &in);

/// Reads the structure of a .prm or .json file, so that every fault is named
/// with its line before ParameterHandler reads the file. Throws InputError:
/// missing file, unreadable line, section left open, a key set twice.
std::vector<Assignment> read_assignments(const std::string &file);
} // namespace spall
