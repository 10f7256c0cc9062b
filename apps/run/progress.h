#pragma once

#include <chrono>
#include <fstream>
#include <string>

namespace spall
{
/// Progress of a long run on standard output: one line that renews itself on a
/// terminal, a plain line every ten seconds elsewhere. Lines that stay also go
/// to a log file.
class Progress
{
public:
  /// Appends to `log_file`.
  explicit Progress(const std::string &log_file);
  ~Progress();
  Progress(const Progress &) = delete;
  Progress &operator=(const Progress &) = delete;

  /// True when show() would print: ask before gathering what it needs.
  bool is_due() const;
  /// `share` of the whole that is done, 0 to 1; `rate` in steps per second
  /// since the start of the phase.
  void show(const std::string &phase, double share, double rate);
  /// A line that stays.
  void say(const std::string &line);

private:
  using Clock = std::chrono::steady_clock;
  std::ofstream log;
  bool is_terminal;
  bool has_open_line = false;
  std::string phase_before;
  double share_before = 0.;
  Clock::time_point phase_start, last_shown;
};
} // namespace spall
