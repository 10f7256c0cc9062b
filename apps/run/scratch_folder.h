#pragma once

#include <filesystem>

namespace spall
{
/// An empty folder among the temporary files of the system, gone with all that
/// has come into it when this is.
class ScratchFolder
{
public:
  /// Throws InputError where there is no room for it.
  ScratchFolder();
  ~ScratchFolder();
  ScratchFolder(const ScratchFolder &) = delete;
  ScratchFolder &operator=(const ScratchFolder &) = delete;

  const std::filesystem::path &path() const { return location; }

private:
  std::filesystem::path location;
};
} // namespace spall
