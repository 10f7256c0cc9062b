#include "run/progress.h"

#include <cmath>
#include <cstdio>
#include <iostream>
#include <unistd.h>

namespace spall
{
namespace
{
std::string in_minutes(double seconds)
{
  char text[32];
  const long whole = std::lround(seconds);
  std::snprintf(text, sizeof text, "%ld:%02ld", whole / 60, whole % 60);
  return text;
}
} // namespace

Progress::Progress(const std::string &log_file)
    : log(log_file, std::ios::app), is_terminal(isatty(STDOUT_FILENO) == 1),
      phase_start(Clock::now()), last_shown(phase_start)
{
}

Progress::~Progress()
{
  if (has_open_line)
    std::cout << std::endl;
}

bool Progress::is_due() const
{
  return std::chrono::duration<double>(Clock::now() - last_shown).count() >
         (is_terminal ? 0.5 : 10.);
}

void Progress::show(const std::string &phase, double share, double rate)
{
  last_shown = Clock::now();
  if (phase != phase_before)
  {
    phase_before = phase;
    phase_start = last_shown;
    share_before = share;
  }
  char text[160];
  std::snprintf(text, sizeof text, "%-13s %5.1f %%  %8.0f steps/s",
                phase.c_str(), 100. * share, rate);
  std::string line = text;
  const double spent =
      std::chrono::duration<double>(last_shown - phase_start).count();
  if (share > share_before && spent > 0.)
    line += "  " + in_minutes(spent * (1. - share) / (share - share_before)) +
            " left";
  if (is_terminal)
    std::cout << '\r' << line << "      " << std::flush;
  else
    std::cout << line << std::endl;
  has_open_line = is_terminal;
}

void Progress::say(const std::string &line)
{
  if (has_open_line)
    std::cout << '\n';
  has_open_line = false;
  std::cout << line << std::endl;
  log << line << std::endl;
}
} // namespace spall
