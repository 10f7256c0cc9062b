#pragma once

#include <dem/parallel/ranks.h>

#include <filesystem>
#include <fstream>
#include <functional>
#include <stdexcept>
#include <string>

namespace spall
{
/// Finished preparations in a folder, one file each, by the hash of what
/// decides them. Several programs may use one folder at a time: a file is there
/// whole or not at all, and two that prepare the same write the same.
class PreparationStore
{
public:
  /// Of the preparation that this text decides. Makes the folder; throws
  /// InputError if it cannot.
  PreparationStore(std::filesystem::path folder, std::string text);

  /// Has the state where a preparation ended restored on all ranks. False if
  /// the first of them finds no such file, or none that is sound: `said` has a
  /// line for the log then. Collective.
  bool take(const dem::Ranks &ranks,
            const std::function<void(std::istream &)> &restore,
            std::string &said) const;

  /// Writes the file: what `save`, called on all ranks, puts out on the first.
  /// Returns a line for the log: a file that cannot be written is no reason to
  /// stop a run. Collective.
  std::string store(const dem::Ranks &ranks,
                    const std::function<void(std::ostream &)> &save) const;

  const std::filesystem::path &path() const { return file; }

private:
  /// Opens the file, up to the state; throws std::runtime_error.
  std::ifstream open_state() const;
  /// As a line for the log.
  std::string unsound(const std::runtime_error &fault) const;

  std::string text; ///< of the preparation
  std::filesystem::path file;
};
} // namespace spall
