#pragma once

#include "run/options.h"
#include "run/whole_file.h"

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

namespace spall
{
/// A CSV file of a run that can be cut back to what a checkpoint knew.
class CsvFile
{
public:
  /// Starts the file with its header line, or goes on behind `size` bytes.
  /// Throws RunFailure if it cannot be written.
  void open(const std::filesystem::path &path, const std::string &header);
  void resume(const std::filesystem::path &path, std::uint64_t size);

  void write_row(const std::vector<double> &values);
  /// Bytes on disk, everything flushed.
  std::uint64_t flushed_size();

private:
  std::ofstream stream;
  std::filesystem::path name;
};

/// Whether the folder holds a run that came to its end.
bool holds_complete_run(const std::filesystem::path &folder);

/// Makes the folder of a run and its subfolders frames/ and checkpoint/. Unless
/// it is resumed, results of an earlier run in it are removed. Throws
/// InputError if the path is a file, holds other things than a run, the case
/// file itself, or, unless told to overwrite it, a run that can be resumed.
void prepare_run_folder(const RunOptions &options);
} // namespace spall
