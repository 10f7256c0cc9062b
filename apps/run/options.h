#pragma once

#include "case/file.h"

#include <optional>
#include <string>
#include <vector>

namespace spall
{
/// Options of `spall run`.
struct RunOptions
{
  std::string case_file, out; ///< out: the run folder
  /// Folder of finished preparations, which tests share; empty: none.
  std::string preparations;
  std::vector<Override> overrides;
  std::optional<int> threads, until; ///< until: cycles or turns
  bool is_resumed = false;
  bool is_overwriting = false; ///< a run that could be resumed
};

/// Whether the user requested a stop (SIGINT, SIGTERM).
bool is_stop_asked();
/// Requests one, as such a signal does.
void request_stop();

/// Runs a case of its kind into its folder. Throws InputError or RunFailure.
void run_test(const RunOptions &options, const Case &parameters);
} // namespace spall
