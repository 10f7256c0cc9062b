#pragma once

#include <filesystem>
#include <vector>

namespace spall
{
/// Search path of files that come with the program, in this order: the
/// folder that the environment names in SPALL_DATA_DIR, that beside the
/// program (PREFIX/share/spall/data for PREFIX/bin/spall), that of the source
/// tree, that of the prefix of the installation, that of the Debian package.
std::vector<std::filesystem::path> data_folders();
} // namespace spall
