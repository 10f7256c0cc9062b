#include "case/file.h"
#include "case/parameter_json.h"
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

std::string joined_kinds()
{
  std::string kinds;
  for (const std::string &kind : kind_names())
    kinds += kind + ", ";
  return kinds;
}
} // namespace

int template_command(Words words)
{
  if (!words.empty() && words[0] == "parameters")
    return parameters(words);
  const bool is_json = words.size() == 2 && words[1] == "--json";
  if (words.size() != 1 && !is_json)
    throw InputError("template: a kind must be given, one of " +
                     joined_kinds() +
                     "which give a commented case (with --json behind it every "
                     "parameter as JSON), or parameters [--out FOLDER] (tables "
                     "in Markdown)");
  if (is_json && !find_kind(words[0]))
    throw InputError("template " + words[0] + " --json: kind must be one of " +
                     joined_kinds() + "without --json also parameters");
  std::cout << (is_json ? template_json(words[0]) : template_case(words[0]));
  return 0;
}
} // namespace spall
