#pragma once

#include "case/case.h"

#include <dem/contact/narrow.h>
#include <dem/io/vtk_output.h>
#include <dem/parallel/ranks.h>

#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <vector>

namespace spall
{
/// Names the layout of states in files: another one, another number.
inline constexpr std::uint64_t state_layout =
    0x314c4c4150530a25 + ((sizeof(dem::Narrow) - sizeof(float)) << 8);

/// The files of a run at a checkpoint.
struct Progressed
{
  std::map<std::string, std::uint64_t> table_sizes; ///< by file name [bytes]
  int n_frames = 0;
  std::vector<dem::FrameEntry> frames;
  std::map<std::string, double> spent; ///< wall-clock by phase [s]
};

/// Writes the whole state (`save`, called on all ranks, that of the test), or
/// leaves the last checkpoint as it was. `done` counts on the first rank.
/// Throws RunFailure. Collective.
void write_checkpoint(const dem::Ranks &ranks,
                      const std::filesystem::path &path, const Case &parameters,
                      const std::function<void(std::ostream &)> &save,
                      const Progressed &done);

/// Whether this program could read what is at this path.
bool is_of_this_version(const std::filesystem::path &path);

/// Throws InputError if there is no checkpoint at this path.
void require_checkpoint(const std::filesystem::path &path);

/// Throws std::runtime_error if a restored run has come further
/// than the end of the present case.
void refuse_shorter(const char *key, double done, double asked);

/// Restores test and files: the first rank reads, and `restore` is called on
/// all with the same bytes. Throws InputError if there is no checkpoint, it
/// is damaged, or it belongs to a case with other parameters or other contents
/// of the files that it names. Parameters with the flag may_change may differ,
/// and those of TestKind::may_change. Collective.
void read_checkpoint(const dem::Ranks &ranks, const std::filesystem::path &path,
                     const Case &parameters,
                     const std::function<void(std::istream &)> &restore,
                     Progressed &done);
} // namespace spall
