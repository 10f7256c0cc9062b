#pragma once

#include <cstdint>
#include <filesystem>
#include <string_view>

namespace spall
{
/// An open file that is written from front to back. It stores the first error
/// of the system, after which it writes no more.
class FileHandle
{
public:
  FileHandle() = default;
  ~FileHandle() { close(); }
  FileHandle(const FileHandle &) = delete;
  FileHandle &operator=(const FileHandle &) = delete;

  /// Makes the file if there is none.
  void open_empty(const std::filesystem::path &path);
  void open_at_end(const std::filesystem::path &path);
  /// A folder, to synchronise it.
  void open_folder(const std::filesystem::path &path);

  void write(std::string_view bytes);
  /// Returns when what was written is on the disk (fsync). Devices and file
  /// systems that cannot do this are left alone.
  void synchronise();
  void close();

  /// Cuts the file back, also after an error, which stays.
  void truncate(std::uint64_t size);

  /// errno of the first call that failed; 0: none.
  int error() const { return first_error; }

private:
  void open(const std::filesystem::path &path, int flags);
  void note_error();

  int descriptor = -1;
  int first_error = 0;
};
} // namespace spall
