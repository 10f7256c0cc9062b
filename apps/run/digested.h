#pragma once

#include <filesystem>
#include <functional>
#include <ostream>

namespace spall
{
/// What `write` puts out, and behind it eight bytes: its digest.
void write_digested(std::ostream &out,
                    const std::function<void(std::ostream &)> &write);

/// Whether the last eight bytes of the file are the digest of all others.
bool is_as_digested(const std::filesystem::path &path);
} // namespace spall
