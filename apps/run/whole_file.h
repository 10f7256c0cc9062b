#pragma once

#include <filesystem>
#include <functional>
#include <ostream>
#include <string>

namespace spall
{
/// What a loss of power may take from a file that has its name.
enum class Durability
{
  usual,  ///< what the system has not yet written to the disk
  on_disk ///< nothing: file and name are synchronised (fsync)
};

/// Path and error of the system as a message: "PATH: cannot be written: No
/// space left on device".
std::string write_failure(const std::filesystem::path &path, int error);

/// Writes a file whole or not at all: what `write` puts out becomes the draft
/// PATH.part, which takes the name PATH once it is written, closed and checked.
/// A pipe or a device is written directly. Throws RunFailure.
void write_whole(const std::filesystem::path &path,
                 const std::function<void(std::ostream &)> &write,
                 Durability durability = Durability::usual);

/// The same of a file that several programs may write at one time: each of them
/// has a draft of its own.
void write_shared(const std::filesystem::path &path,
                  const std::function<void(std::ostream &)> &write);

/// The same of a text.
void write_text(const std::filesystem::path &path, const std::string &text,
                Durability durability = Durability::on_disk);

/// The same to a path that the user gave: throws InputError if it cannot be
/// opened, RunFailure if it cannot be written after that.
void write_asked(const std::filesystem::path &path, const std::string &text);
} // namespace spall
