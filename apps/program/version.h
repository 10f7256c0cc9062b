#pragma once

#include <string>

namespace spall
{
/// Commit of the sources when the program was built, or "unknown".
extern const char *const source_commit;

/// Version, commit, and the libraries that the program was built with, one on
/// each line.
std::string version_text();
} // namespace spall
