#pragma once

#include "run/appended_file.h"

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace spall
{
/// A line of a CSV file. Its numbers are the shortest that read back as the
/// same.
std::string csv_row(const std::vector<double> &values);

/// A CSV file of a run that can be cut back to what a checkpoint knew. All
/// members throw RunFailure if the file cannot be written.
class CsvFile
{
public:
  /// Starts the file with its header line.
  void open(const std::filesystem::path &path, const std::string &header);
  /// Continues the file behind its first `size` bytes. Throws InputError if it
  /// has fewer.
  void resume(const std::filesystem::path &path, std::uint64_t size);

  void write_row(const std::vector<double> &values);
  /// Number of bytes of the file, with every row on the disk.
  std::uint64_t flushed_size();

private:
  AppendedFile file;
};
} // namespace spall
