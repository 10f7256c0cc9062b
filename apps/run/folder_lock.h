#pragma once

#include <filesystem>

namespace spall
{
/// Keeps other runs out of a run folder as long as it lives. File systems
/// without such locks let them in.
class FolderLock
{
public:
  /// Throws InputError if another run has the folder.
  explicit FolderLock(const std::filesystem::path &folder);
  ~FolderLock();
  FolderLock(const FolderLock &) = delete;
  FolderLock &operator=(const FolderLock &) = delete;

private:
  int file = -1; ///< the open folder
};
} // namespace spall
