// hard_cases [NAME ...] [--list] [--page FILE]: runs all cases or those named;
// status 1 if one does not do what its row says.
#include "hard_case.h"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <exception>
#include <fstream>

namespace
{
std::vector<hard::Case> all_cases()
{
  std::vector<hard::Case> all;
  for (const auto &family :
       {hard::membrane_cases(), hard::plate_cases(), hard::particle_cases()})
    all.insert(all.end(), family.begin(), family.end());
  return all;
}

hard::Row row_of(const hard::Case &one)
{
  try
  {
    return one.run();
  }
  catch (const std::exception &error)
  {
    return {std::string("stopped: ") + error.what(), "", false};
  }
}

const char *words(hard::Restart restart)
{
  return restart == hard::Restart::same_bits ? "bit for bit"
         : restart == hard::Restart::differs ? "differs"
                                             : "-";
}

bool is_right(const hard::Row &row)
{
  return row.holds && row.restart != hard::Restart::differs;
}

const char *outcome(const hard::Row &row)
{
  return !is_right(row) ? "FAILS" : row.is_stopped ? "stopped" : "held";
}

const char *const page_head =
    "# Hard cases\n\n"
    "Written by `build/tests/verification/hard_cases --page "
    "docs/verification/hard.md`, one test each (`ctest -R hard_`). *held*: as "
    "it must be within\nthe limits given; *stopped*: it cannot be held, and a "
    "guard stops it with this line ([guards](../theory/interface.md#guards)). "
    "The margin\nsays how far it is from the border. Restart: the second half "
    "of the run once more, from a state saved in its middle.\n\n"
    "| case | what makes it hard | what happens | margin or limit | restart | "
    "outcome |\n|---|---|---|---|---|---|\n";

} // namespace

int main(int argc, char **argv)
{
  std::vector<std::string> names(argv + 1, argv + argc);
  std::string page;
  if (names.size() == 2 && names[0] == "--page")
  {
    page = names[1];
    names.clear();
  }
  std::string table = page_head;
  bool all_hold = true;
  std::size_t n_run = 0;
  for (const hard::Case &one : all_cases())
  {
    if (names == std::vector<std::string>{"--list"})
    {
      std::printf("%s: %s\n", one.name.c_str(), one.what.c_str());
      continue;
    }
    if (!names.empty() && std::ranges::find(names, one.name) == names.end())
      continue;
    ++n_run;
    const auto start = std::chrono::steady_clock::now();
    const hard::Row row = row_of(one);
    all_hold &= is_right(row);
    const std::chrono::duration<double> took =
        std::chrono::steady_clock::now() - start;
    std::printf("%-18s %-7s %s | %s | restart %s (%.1f s)\n", one.name.c_str(),
                outcome(row), row.happens.c_str(), row.margin.c_str(),
                words(row.restart), took.count());
    std::fflush(stdout);
    table += "| `" + one.name + "`: " + one.what + " | " + one.why + " | " +
             row.happens + " | " + row.margin + " | " + words(row.restart) +
             " | " + outcome(row) + " |\n";
  }
  if (!names.empty() && names[0] != "--list" && n_run != names.size())
  {
    std::fprintf(stderr, "hard_cases: no such case; see --list\n");
    return 1;
  }
  if (!page.empty())
    std::ofstream(page) << table;
  return all_hold ? 0 : 1;
}
