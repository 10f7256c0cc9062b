#include "commands/commands.h"

#include <iostream>

namespace spall
{
void report_deprecated(const std::vector<std::string> &lines)
{
  for (const std::string &line : lines)
    std::cerr << "spall: " << line << std::endl;
}
} // namespace spall
