#include "case/data_folders.h"

#include <cstdlib>

namespace spall
{
std::vector<std::filesystem::path> data_folders()
{
  std::vector<std::filesystem::path> folders;
  if (const char *chosen = std::getenv("SPALL_DATA_DIR"))
    folders.emplace_back(chosen);
  folders.emplace_back(SPALL_DATA_DIR);
  return folders;
}
} // namespace spall
