#pragma once

#include "run/appended_file.h"
#include "run/time_left.h"

#include <chrono>
#include <string>

namespace spall
{
/// Progress of a long run on standard output: one line that renews itself on a
/// terminal, a plain line every ten seconds elsewhere. Lines that stay also go
/// to a log file.
class Progress
{
public:
  /// Appends to `log_file`; says nothing if that is empty. Throws RunFailure if
  /// it cannot be written, as say() does.
  explicit Progress(const std::string &log_file);
  ~Progress();
  Progress(const Progress &) = delete;
  Progress &operator=(const Progress &) = delete;

  /// True when show() would print: check before gathering what it needs.
  bool is_due() const;
  /// `share` of the whole that is done, 0 to 1; `rate` in steps per second;
  /// `numbers`: what the test has come to, as it is to be read.
  void show(const std::string &phase, double share, double rate,
            const std::string &numbers);
  /// A line that stays.
  void say(const std::string &line);

private:
  using Clock = std::chrono::steady_clock;
  AppendedFile log;
  bool is_silent;
  bool is_terminal;
  bool has_open_line = false;
  Clock::time_point started, last_shown;
  TimeLeft time_left;
};
} // namespace spall
