// hard_cases [NAME ...] [--list] [--page FILE]: runs all cases or those named;
// status 1 if one does not do what its row says.
#include "hard_case.h"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <exception>
#include <filesystem>
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
    "This page lists cases at the border of what the program can hold, and "
    "whether it holds them or a guard stops them.\n"
    "Every case is a test (`ctest -R hard_`).\n\n"
    "```sh\nbuild/tests/verification/hard_cases --list\n"
    "build/tests/verification/hard_cases --page docs/verification/hard.md   "
    "# renews this page and its table\n```\n\n"
    "*held*: within the limits of the case. *stopped*: it cannot be held, and "
    "a [guard](../theory/interface.md#guards)\nstops it with a message. The "
    "second half of each run is repeated from a state saved in its middle; "
    "*restart* says how it\nagrees.\n\n"
    "What makes each case hard, what happens, its margin or limit and the "
    "message of the guard:\n[hard.csv](hard.csv).\n\n"
    "| case | scene | outcome | restart |\n|---|---|---|---|\n";

const char *const table_head =
    "case,scene,what makes it hard,what happens,margin or limit,restart,"
    "outcome\n";

std::string quoted(const std::string &text)
{
  std::string out = "\"";
  for (const char c : text)
    out += c == '"' ? std::string("\"\"") : std::string(1, c);
  return out + "\"";
}

std::string table_row(const hard::Case &one, const hard::Row &row)
{
  return one.name + "," + quoted(one.what) + "," + quoted(one.why) + "," +
         quoted(row.happens) + "," + quoted(row.margin) + "," +
         words(row.restart) + "," + outcome(row) + "\n";
}

std::string page_row(const hard::Case &one, const hard::Row &row)
{
  return "| `" + one.name + "` | " + one.what + " | " + outcome(row) + " | " +
         words(row.restart) + " |\n";
}

/// The page, and the whole table beside it.
void write(const std::string &page, const std::string &rows,
           const std::string &table)
{
  std::ofstream(page) << page_head << rows;
  std::ofstream(std::filesystem::path(page).replace_extension(".csv"))
      << table_head << table;
}
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
  std::string rows, table;
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
    rows += page_row(one, row);
    table += table_row(one, row);
  }
  if (!names.empty() && names[0] != "--list" && n_run != names.size())
  {
    std::fprintf(stderr, "hard_cases: no such case; see --list\n");
    return 1;
  }
  if (!page.empty())
    write(page, rows, table);
  return all_hold ? 0 : 1;
}
