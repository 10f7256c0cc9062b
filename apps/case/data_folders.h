#pragma once

#include <filesystem>
#include <vector>

namespace spall
{
/// Where files that come with the program are looked for, in this order: the
/// folder that the environment names in SPALL_DATA_DIR, then that of the build.
std::vector<std::filesystem::path> data_folders();
} // namespace spall
