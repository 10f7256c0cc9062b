#pragma once

#include "run/options.h"

#include <filesystem>
#include <string>

namespace spall
{
/// Whether the folder holds a run that came to its end.
bool holds_complete_run(const std::filesystem::path &folder);

/// Whether this is a folder that is empty or has no more than a run makes
/// before it writes case.prm: empty subfolders, an empty log.txt, a draft.
bool holds_first_traces(const std::filesystem::path &folder);

/// Where an earlier run in the folder ended before its first checkpoint, this
/// one starts from the beginning, also if it was to be resumed: `options` are
/// changed to that. Returns a line that reports it; else an empty one.
std::string start_over_if_interrupted(RunOptions &options);

/// Makes the folder of a run and its subfolders frames/ and checkpoint/. Unless
/// it is resumed, results of an earlier run in it are removed, and no other
/// file. Throws InputError if the path is a file, holds other things than a
/// run, the case file itself, or, unless it may be overwritten, a run that can
/// be resumed.
void prepare_run_folder(const RunOptions &options);
} // namespace spall
