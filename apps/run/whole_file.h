#pragma once

#include <filesystem>
#include <functional>
#include <ostream>
#include <string>

namespace spall
{
/// Writes a file whole or not at all: what `write` puts out becomes a draft
/// beside it that takes its name in the end. Throws RunFailure.
void write_whole(const std::filesystem::path &path,
                 const std::function<void(std::ostream &)> &write);

/// The same of a text.
void write_text(const std::filesystem::path &path, const std::string &text);

/// The same to a path that the user gave: throws InputError.
void write_asked(const std::filesystem::path &path, const std::string &text);
} // namespace spall
