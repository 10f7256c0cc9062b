#pragma once

#include <filesystem>
#include <functional>
#include <memory>
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

/// How many programs may write a file at one time.
enum class Writers
{
  one,
  several ///< each of them has a draft of its own
};

/// A file that is written whole or not at all: what goes to `out` becomes the
/// draft PATH.part, which takes the name PATH by finish(), and goes without it.
/// A pipe or a device is written directly.
class WholeFile
{
public:
  /// Opens the draft; see error().
  WholeFile(std::filesystem::path path, Durability durability, Writers writers);
  ~WholeFile();
  WholeFile(const WholeFile &) = delete;
  WholeFile &operator=(const WholeFile &) = delete;

  std::ostream &out();
  /// Closes and checks the draft, which becomes the file.
  void finish();
  bool is_opened() const;
  int error() const; ///< errno; 0: none so far
  /// Throws RunFailure if there is one.
  void require_sound() const;

private:
  class Draft;
  std::unique_ptr<Draft> draft;
};

/// What `write` puts out as a WholeFile. Throws RunFailure.
void write_whole(const std::filesystem::path &path,
                 const std::function<void(std::ostream &)> &write,
                 Durability durability = Durability::usual);

/// The same of a text.
void write_text(const std::filesystem::path &path, const std::string &text,
                Durability durability = Durability::on_disk);

/// The same to a path that the user gave: throws InputError if it cannot be
/// opened, RunFailure if it cannot be written after that.
void write_asked(const std::filesystem::path &path, const std::string &text);
} // namespace spall
