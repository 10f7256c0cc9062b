// The program for tests that start it hundreds of times: each command runs in a
// fork of this process, which has loaded the libraries already (most of the
// time of a short command). A command on standard input is the folder it runs
// in, the files of its standard output and error, and its words, with a 0x1f
// between and a 0x1e behind. Its exit status, or minus the signal that ended
// it, is a line on standard output.
#include "program/program.h"

#include <cstdio>
#include <cstdlib>
#include <iostream>
#include <string>
#include <sys/wait.h>
#include <unistd.h>
#include <vector>

namespace
{
/// After which a command is ended [s].
constexpr unsigned patience = 100;

std::vector<std::string> fields_of(const std::string &record)
{
  std::vector<std::string> fields(1);
  for (const char c : record)
    if (c == '\x1f')
      fields.emplace_back();
    else
      fields.back() += c;
  return fields;
}

/// In the fork. Does not return.
void run(std::vector<std::string> fields)
{
  const bool is_there = chdir(fields[0].c_str()) == 0 &&
                        std::freopen(fields[1].c_str(), "w", stdout) &&
                        std::freopen(fields[2].c_str(), "w", stderr);
  if (!is_there)
    _exit(99);
  std::vector<char *> words;
  std::string name = "spall";
  words.push_back(name.data());
  for (std::size_t k = 3; k < fields.size(); ++k)
    words.push_back(fields[k].data());
  words.push_back(nullptr);
  alarm(patience);
  std::exit(
      spall::program_main(static_cast<int>(words.size()) - 1, words.data()));
}

int status_of(const std::string &record)
{
  const pid_t child = fork();
  if (child == 0)
    run(fields_of(record));
  int status = 0;
  if (child < 0 || waitpid(child, &status, 0) != child)
    return 98;
  return WIFSIGNALED(status) ? -WTERMSIG(status) : WEXITSTATUS(status);
}
} // namespace

int main()
{
  std::string record;
  while (std::getline(std::cin, record, '\x1e'))
    std::cout << status_of(record) << std::endl;
}
