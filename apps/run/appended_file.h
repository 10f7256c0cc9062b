#pragma once

#include "run/file_handle.h"

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace spall
{
/// A text file that grows by whole lines. Every write to the system is checked;
/// after one that failed the file ends with the last line before it. All
/// members but the destructor throw RunFailure with path and error.
class AppendedFile
{
public:
  AppendedFile() = default;
  ~AppendedFile(); ///< writes what is left, unchecked: flush() before
  AppendedFile(const AppendedFile &) = delete;
  AppendedFile &operator=(const AppendedFile &) = delete;

  void open_empty(const std::filesystem::path &path);
  void open_at_end(const std::filesystem::path &path);

  /// Adds lines, each with its end; they are written when there are many.
  void add(std::string_view lines);
  void flush();
  /// The same, down to the disk.
  void synchronise();

  /// Of what has been written [bytes].
  std::uint64_t size() const { return n_bytes; }

private:
  void require_written();

  std::filesystem::path name;
  FileHandle file;
  std::string pending;
  std::uint64_t n_bytes = 0;
};
} // namespace spall
