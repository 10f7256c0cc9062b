#include "program/program.h"

#include "commands/commands.h"
#include "errors.h"
#include "program/version.h"
#include "program/wait_policy.h"

#include <dem/parallel/mpi_session.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdio>
#include <dlfcn.h>
#include <iostream>
#include <memory>
#include <string>
#include <system_error>
#include <vector>

namespace spall
{
namespace
{

/// Which processes a command may be started on.
enum class Processes
{
  without_mpi,
  many_ranks,   ///< with deal.II
  engine_ranks, ///< without it
};

struct Command
{
  const char *name, *arguments, *sentence;
  int (*run)(Words);
  Processes processes;
};

constexpr std::array<Command, 8> commands = {
    {{"template", "KIND [--json] | parameters [--out FOLDER]",
      "print a commented case of a kind (--json: a list of its parameters), or "
      "the pages of all parameters",
      template_command, Processes::without_mpi},
     {"check",
      "CASE.prm [--preparations DIR] [--json] [--set Section/key=value ...]",
      "validate; print particles, stable step, gain, memory, time (--json: "
      "validate alone, and print all values)",
      check_command, Processes::many_ranks},
     {"run",
      "CASE.prm [--out DIR] [--preparations DIR] [--threads N] [--resume] "
      "[--overwrite] [--until CYCLES] [--set Section/key=value ...]",
      "run the case; --resume continues a stopped run, --overwrite starts it "
      "again",
      run_command, Processes::many_ranks},
     {"report", "DIR [DIR ...] [--out FILE] [--figures FOLDER]",
      "write a self-contained report.html", report_command,
      Processes::without_mpi},
     {"study",
      "STUDY.prm [--out DIR] [--finished] [--part K/N] [--jobs N] "
      "[--threads-per-case N] [--ranks-per-case N] [--mpirun WORDS] "
      "[--figures FOLDER] [--page FILE] [--set Section/key=value ...]",
      "run or continue a sweep of cases; table and report", study_command,
      Processes::without_mpi},
     {"shape",
      "fit MESH --order N --out S.json [--from rays|vertices] "
      "[--max-overhang F] [--max-misfit F] [--unit m|mm|um] [--json FILE] "
      "[--source TEXT] "
      "[--licence TEXT] | info S.json|MESH [--unit m|mm|um] [--json FILE] | "
      "corners MESH [S.json] --out DIR [--order N] [--patch F] "
      "[--unit m|mm|um] [--json FILE] | generate SAMPLE_DIR [SAMPLE_DIR ...] "
      "--count N --seed K --out DIR "
      "[--order N] [--json FILE]",
      "fit, measure, compare and generate particle shapes", shape_command,
      Processes::without_mpi},
     {"bench",
      "--packing P.csv [--steps N] [--threads N] [--shapes DIR] "
      "[--geometry sphere|radial|surface] [--breakage] "
      "[--scene rest|jolt|collapse] [--repeat N] [--settle N] [--copies N] "
      "[--json FILE] [--save P.csv]",
      "time the particle engine on a packing", bench_command,
      Processes::engine_ranks},
     {"verify", "[FAMILY ...] [--list] [--csv FILE] [--page FILE]",
      "print what is known beside what the program computes", verify_command,
      Processes::without_mpi}}};

std::string usage()
{
  std::string text = "usage: spall COMMAND ...   (spall --version, --help)\n";
  for (const Command &command : commands)
    text += std::string("  spall ") + command.name + " " + command.arguments +
            "\n      " + command.sentence + "\n";
  return text;
}

/// OpenBLAS would start one thread per core for matrices of a few rows. It
/// reads its environment before main, so it is set by its own function.
void use_one_blas_thread()
{
  using Setter = void (*)(int);
  if (const auto set = reinterpret_cast<Setter>(
          dlsym(RTLD_DEFAULT, "openblas_set_num_threads")))
    set(1);
}

/// What deal.II and the engine hold of MPI, while a command runs with it. They
/// outlive a failure, which ranks report to each other.
std::unique_ptr<dealii::Utilities::MPI::MPI_InitFinalize> mpi;
std::unique_ptr<dem::MpiSession> session;

int run_with_mpi(const Command &command, Words words)
{
  // PETSc would read our words as its own options.
  int argc = 1;
  std::string name = "spall";
  std::array<char *, 2> arguments = {name.data(), nullptr};
  char **argv = arguments.data();
  mpi =
      std::make_unique<dealii::Utilities::MPI::MPI_InitFinalize>(argc, argv, 1);
  session = std::make_unique<dem::MpiSession>();
  return command.run(words);
}

int run_on_ranks(const Command &command, Words words)
{
  if (dem::is_launched())
    session = std::make_unique<dem::MpiSession>();
  return command.run(words);
}

int dispatch(const Command &command, Words words)
{
  if (std::ranges::find(words, "") != words.end())
    throw InputError(
        std::string(command.name) +
        ": an empty argument: must be a file, an option or its value");
  if (std::ranges::any_of(words, [](const std::string &word)
                          { return word == "--help" || word == "-h"; }))
  {
    std::cout << "usage: spall " << command.name << " " << command.arguments
              << "\n  " << command.sentence << "\n";
    return 0;
  }
  switch (command.processes)
  {
  case Processes::many_ranks:
    return run_with_mpi(command, words);
  case Processes::engine_ranks:
    return run_on_ranks(command, words);
  case Processes::without_mpi:
    break;
  }
  return command.run(words);
}

int run_program(const std::vector<std::string> &words)
{
  if (words.empty())
  {
    std::cerr << usage();
    return 1;
  }
  if (words[0] == "--help" || words[0] == "-h" || words[0] == "help")
  {
    std::cout << usage();
    return 0;
  }
  if (words[0] == "--version")
  {
    std::cout << version_text();
    return 0;
  }
  for (const Command &command : commands)
    if (words[0] == command.name)
      return dispatch(command, Words(words).subspan(1));
  throw InputError(words[0] +
                   ": no such command: must be one of template, "
                   "check, run, report, study, shape, bench, verify");
}

/// A message as the one line that a user gets.
void print_failure(const std::string &what)
{
  std::string line;
  for (const char c : what)
    if (c != '\n')
      line += c;
    else if (!line.empty() && line.back() != ' ')
      line += ' ';
  std::cerr << "spall: " << line << std::endl;
}

/// One message, and the end of all ranks: they wait for a rank that has failed
/// alone.
int fail(const std::string &what, int status)
{
  constexpr double patience = 5.; // [s]
  const bool is_alone = session && !session->all_arrive(patience);
  if (!session || session->is_first() || is_alone)
    print_failure(what);
  if (is_alone)
    dem::end_all_ranks(status);
  return status;
}

/// What is printed is a result too: it must have reached its file or pipe.
int finish_output(int status)
{
  std::cout.flush();
  const std::string why = std::fflush(stdout) == 0
                              ? "an earlier write failed"
                              : std::generic_category().message(errno);
  if (std::ferror(stdout) == 0 || status != 0)
    return status;
  return fail("standard output: cannot be written: " + why, 2);
}

/// Runs the program; a failure becomes a message and a status.
int run_to_end(int argc, char **argv)
{
  try
  {
    return finish_output(
        run_program(std::vector<std::string>(argv + 1, argv + argc)));
  }
  catch (const InputError &error)
  {
    return fail(error.what(), 1);
  }
  catch (const std::invalid_argument &error)
  {
    return fail(error.what(), 1);
  }
  catch (const std::exception &error)
  {
    return fail(error.what(), 2);
  }
  catch (...)
  {
    return fail("unknown failure", 2);
  }
}

} // namespace

int program_main(int argc, char **argv)
{
  apply_wait_policy();
  use_one_blas_thread();
  const int status = run_to_end(argc, argv);
  session.reset();
  mpi.reset();
  return status;
}
} // namespace spall
