#pragma once

#include <filesystem>
#include <vector>

namespace spall
{
/// Search path of files that come with the program, in this order: the
/// folder that the environment names in SPALL_DATA_DIR, then that of the build.
std::vector<std::filesystem::path> data_folders();
} // namespace spall
