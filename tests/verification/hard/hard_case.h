#pragma once

#include <functional>
#include <string>
#include <vector>

/// Cases at the border of what the program can hold, one row each.
namespace hard
{
enum class Restart
{
  none,      ///< nothing to go on with
  same_bits, ///< from a state saved in the middle
  differs
};

struct Row
{
  std::string happens, margin; ///< with the numbers of this run
  bool holds = false;          ///< all that the case asks for
  bool is_stopped = false;     ///< what it asks for is that a guard speaks
  Restart restart = Restart::none;
};

struct Case
{
  std::string name; ///< for the command line
  std::string what; ///< the scene
  std::string why;  ///< what makes it hard
  std::function<Row()> run;
};

std::vector<Case> membrane_cases();
std::vector<Case> plate_cases();
std::vector<Case> particle_cases();

/// printf into a string.
std::string text(const char *format, ...) __attribute__((format(printf, 1, 2)));
} // namespace hard
