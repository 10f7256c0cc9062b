#include "case/file.h"
#include "case/parameter_pages.h"
#include "commands/commands.h"
#include "errors.h"
#include "run/whole_file.h"

#include <filesystem>
#include <iostream>

namespace spall
{
namespace
{
/// Prints the pages of the parameters, or writes them into a folder.
int parameters(Words words)
{
  const bool is_written = words.size() == 3 && words[1] == "--out";
  if (words.size() != 1 && !is_written)
    throw InputError("template parameters: the only option is --out FOLDER");
  const std::filesystem::path folder = is_written ? words[2] : "";
  if (std::error_code error;
      is_written && !std::filesystem::create_directories(folder, error) &&
      error)
    throw InputError("template: cannot make the folder '" + folder.string() +
                     "' (" + error.message() + ")");
  if (!is_written)
    std::cout << parameter_tables();
  else
    for (const ParameterPage &page : parameter_pages())
      write_asked(folder / page.file, page.text);
  return 0;
}
} // namespace

int template_command(Words words)
{
  if (!words.empty() && words[0] == "parameters")
    return parameters(words);
  if (words.size() != 1)
  {
    std::string kinds;
    for (const std::string &kind : kind_names())
      kinds += kind + ", ";
    throw InputError("template: needs one word, one of " + kinds +
                     "which give a commented case, or parameters [--out "
                     "FOLDER] (tables in Markdown)");
  }
  std::cout << template_case(words[0]);
  return 0;
}
} // namespace spall
