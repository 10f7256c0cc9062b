#include "case/data_folders.h"

#include <cstdlib>

namespace spall
{
std::vector<std::filesystem::path> data_folders()
{
  std::vector<std::filesystem::path> folders;
  if (const char *chosen = std::getenv("SPALL_DATA_DIR"))
    folders.emplace_back(chosen);
  // An installed program has its data beside it, wherever it is moved to.
  std::error_code error;
  const std::filesystem::path program =
      std::filesystem::read_symlink("/proc/self/exe", error);
  if (!error)
    folders.push_back(program.parent_path() / ".." / "share" / "spall" /
                      "data");
  for (const char *folder :
       {SPALL_DATA_DIR, SPALL_INSTALLED_DATA_DIR, "/usr/share/spall/data"})
    folders.emplace_back(folder);
  return folders;
}
} // namespace spall
