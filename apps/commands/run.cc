#include "commands/commands.h"
#include "errors.h"
#include "run/options.h"

#include <dem/parallel/mpi_ranks.h>

#include <charconv>
#include <csignal>
#include <filesystem>
#include <limits>

namespace spall
{
namespace
{
int positive(const std::string &option, const std::string &text,
             int most = std::numeric_limits<int>::max())
{
  int value = 0;
  const auto [end, status] =
      std::from_chars(text.data(), text.data() + text.size(), value);
  if (status != std::errc{} || end != text.data() + text.size() || value < 1 ||
      value > most)
    throw InputError(
        "run: " + option + " " + text + ": must be a whole number from 1 " +
        (most < std::numeric_limits<int>::max() ? "to " + std::to_string(most)
                                                : "up"));
  return value;
}

RunOptions run_options(Words words)
{
  RunOptions options;
  for (std::size_t k = 0; k < words.size(); ++k)
  {
    const std::string &word = words[k];
    const auto value = [&]() -> const std::string &
    {
      if (k + 1 == words.size())
        throw InputError("run: " + word + ": a value must follow");
      return words[++k];
    };
    if (word == "--out")
      options.out = value();
    else if (word == "--preparations")
      options.preparations = value();
    else if (word == "--threads")
      options.threads = positive(word, value(), most_threads);
    else if (word == "--until")
      options.until = positive(word, value());
    else if (word == "--resume")
      options.is_resumed = true;
    else if (word == "--overwrite")
      options.is_overwriting = true;
    else if (word == "--set")
      options.overrides.push_back(parse_override(value()));
    else if (word.starts_with("--"))
      throw InputError("run: " + word +
                       ": no such option: must be --out, --preparations, "
                       "--threads, --resume, --overwrite, --until or --set");
    else if (options.case_file.empty())
      options.case_file = word;
    else
      throw InputError("run: " + word + ": only one case file at a time");
  }
  if (options.case_file.empty())
    throw InputError("run: a case file must be given");
  if (options.is_resumed && options.is_overwriting)
    throw InputError("run: --resume and --overwrite: only one of them");
  if (options.out.empty())
    options.out =
        "runs/" + std::filesystem::path(options.case_file).stem().string();
  return options;
}

volatile std::sig_atomic_t stop_asked = 0;

void ask_to_stop(int)
{
  stop_asked = 1;
}
} // namespace

bool is_stop_asked()
{
  return stop_asked != 0;
}

void request_stop()
{
  stop_asked = 1;
}

int run_command(Words words)
{
  const RunOptions options = run_options(words);
  const Case parameters = read_case(options.case_file, options.overrides);
  if (dem::ranks_of_program()->rank() == 0)
    report_deprecated(parameters.deprecated);
  std::signal(SIGINT, ask_to_stop);
  std::signal(SIGTERM, ask_to_stop);
  run_test(options, parameters);
  return 0;
}
} // namespace spall
