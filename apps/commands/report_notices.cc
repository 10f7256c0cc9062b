#include "commands/commands.h"

#include <iostream>

namespace spall
{
void report_notices(const std::vector<std::string> &lines)
{
  for (const std::string &line : lines)
    std::cerr << "spall: note: " << line << std::endl;
}
} // namespace spall
