#include "case/file.h"
#include "commands/commands.h"
#include "errors.h"

#include <iostream>

namespace spall
{
int template_command(Words words)
{
  if (words.size() != 1)
  {
    std::string kinds;
    for (const std::string &kind : kind_names())
      kinds += kind + ", ";
    throw InputError("template: needs one word, one of " + kinds +
                     "which give a commented case, or parameters (tables in "
                     "Markdown)");
  }
  std::cout << (words[0] == "parameters" ? parameter_tables()
                                         : template_case(words[0]));
  return 0;
}
} // namespace spall
