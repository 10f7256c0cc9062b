#include "commands/commands.h"
#include "errors.h"
#include "report/text_table.h"
#include "run/whole_file.h"
#include "verify/families.h"
#include "verify/table.h"

#include <algorithm>
#include <iostream>
#include <sstream>

namespace spall
{
namespace
{
using verify::Family;
using verify::Result;

struct Options
{
  std::vector<Family> families;
  bool is_list = false;
  std::string csv;  ///< file; empty: none
  std::string page; ///< Markdown file whose table is renewed; empty: none
};

Family find_family(const std::string &name)
{
  std::string names;
  for (const Family &family : verify::families())
  {
    if (family.name == name)
      return family;
    names += (names.empty() ? "" : ", ") + family.name;
  }
  throw InputError("verify: no such family '" + name + "' (allowed: " + names +
                   ")");
}

Options parse(Words words)
{
  Options options;
  for (std::size_t k = 0; k < words.size(); ++k)
  {
    const std::string &word = words[k];
    if (word == "--list")
      options.is_list = true;
    else if (word == "--csv" || word == "--page")
    {
      if (k + 1 == words.size() || words[k + 1].starts_with("--"))
        throw InputError("verify: " + word + " needs a file");
      (word == "--csv" ? options.csv : options.page) = words[++k];
    }
    else if (word.starts_with("-"))
      throw InputError("verify: unknown option '" + word +
                       "' (allowed: --list, --csv FILE, --page FILE)");
    else
      options.families.push_back(find_family(word));
  }
  if (options.families.empty())
    options.families = verify::families();
  return options;
}

void print_list(const std::vector<Family> &families)
{
  for (const Family &family : families)
  {
    std::cout << family.name << ": " << family.subject << '\n';
    for (const verify::Case &one : family.cases)
      std::cout << "  " << one.name << ": " << one.source << '\n';
  }
}

void write_files(const Options &options, const std::vector<Result> &results)
{
  std::ostringstream csv, page;
  verify::write_csv(results, csv);
  verify::write_markdown(options.families, results, page);
  if (!options.csv.empty())
    write_asked(options.csv, csv.str());
  if (!options.page.empty())
    renew_page("verify", options.page, "<!-- spall verify --page -->",
               page.str());
}
} // namespace

int verify_command(Words words)
{
  const Options options = parse(words);
  if (options.is_list)
  {
    print_list(options.families);
    return 0;
  }
  std::vector<Result> results;
  for (const Family &family : options.families)
  {
    const std::vector<Result> part = verify::run(family);
    results.insert(results.end(), part.begin(), part.end());
  }
  verify::print_table(results, std::cout);
  write_files(options, results);
  const auto n_failed =
      std::ranges::count_if(results, [](const Result &result)
                            { return !verify::is_held(result.row); });
  std::cout << results.size() << " numbers, " << n_failed << " fail\n";
  if (n_failed > 0)
    throw RunFailure("verify: " + std::to_string(n_failed) + " of " +
                     std::to_string(results.size()) +
                     " numbers are outside their tolerance");
  return 0;
}
} // namespace spall
