#pragma once

#include <string>
#include <string_view>

namespace fem
{
/// Writes and closes the file. Throws std::runtime_error with path and error of
/// the system if any of it fails.
void write_output(const std::string &path, std::string_view bytes);
} // namespace fem
