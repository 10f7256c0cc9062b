#include "run/progress.h"

#include <cmath>
#include <cstdio>
#include <iostream>
#include <unistd.h>

namespace spall
{
namespace
{
/// A line that renews itself must not run over the edge of the terminal, and
/// clears what is left of the one before.
constexpr const char *cut_at_edge = "\r\x1b[?7l",
                     *clear_rest = "\x1b[K\x1b[?7h";
} // namespace

Progress::Progress(const std::string &log_file)
    : is_silent(log_file.empty()), is_terminal(isatty(STDOUT_FILENO) == 1),
      started(Clock::now()), last_shown(started)
{
  if (!is_silent)
    log.open_at_end(log_file);
}

Progress::~Progress()
{
  if (has_open_line)
    std::cout << std::endl;
}

bool Progress::is_due() const
{
  return !is_silent &&
         std::chrono::duration<double>(Clock::now() - last_shown).count() >
             (is_terminal ? 0.5 : 10.);
}

void Progress::show(const std::string &phase, double share, double rate,
                    const std::string &numbers)
{
  if (is_silent)
    return;
  last_shown = Clock::now();
  char text[160];
  std::snprintf(text, sizeof text, "%-13s %5.1f %%  %8.0f steps/s",
                phase.c_str(), 100. * share, rate);
  std::string line = text;
  const std::chrono::duration<double> so_far = last_shown - started;
  if (const double left = time_left.after(so_far.count(), share);
      std::isfinite(left))
    line += "  " + in_minutes(left) + " left";
  if (!numbers.empty())
    line += "  " + numbers;
  if (is_terminal)
    std::cout << cut_at_edge << line << clear_rest << std::flush;
  else
    std::cout << line << std::endl;
  has_open_line = is_terminal;
}

void Progress::say(const std::string &line)
{
  if (is_silent)
    return;
  if (has_open_line)
    std::cout << '\n';
  has_open_line = false;
  std::cout << line << std::endl;
  log.add(line + "\n");
  log.flush();
}
} // namespace spall
