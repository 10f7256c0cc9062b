#include "study/programs.h"

#include <array>
#include <atomic>
#include <csignal>
#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

namespace spall
{
namespace
{
/// Data for a signal handler: running programs, 0 where there is none.
std::array<std::atomic<pid_t>, 256> running{};
std::atomic<bool> is_stopped = false;
static_assert(std::atomic<pid_t>::is_always_lock_free);

void stop_programs(int)
{
  is_stopped = true;
  for (const std::atomic<pid_t> &program : running)
    if (const pid_t id = program; id > 0)
      kill(id, SIGTERM);
}

/// A program among those that are stopped with this one.
class Registered
{
public:
  explicit Registered(pid_t id)
  {
    for (std::atomic<pid_t> &one : running)
      if (pid_t nobody = 0; one.compare_exchange_strong(nobody, id))
      {
        slot = &one;
        break;
      }
    if (is_stopped) // meanwhile
      kill(id, SIGTERM);
  }
  ~Registered()
  {
    if (slot)
      *slot = 0;
  }
  Registered(const Registered &) = delete;
  Registered &operator=(const Registered &) = delete;

private:
  std::atomic<pid_t> *slot = nullptr;
};
} // namespace

int run_program(const std::vector<std::string> &words,
                const std::filesystem::path &log)
{
  std::vector<char *> arguments;
  for (const std::string &word : words)
    arguments.push_back(const_cast<char *>(word.c_str()));
  arguments.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, log.c_str(),
                                   O_WRONLY | O_CREAT | O_TRUNC, 0644);
  posix_spawn_file_actions_adddup2(&actions, STDOUT_FILENO, STDERR_FILENO);
  pid_t child = 0;
  const bool is_this = words.front() == "spall";
  const int fault =
      posix_spawnp(&child, is_this ? "/proc/self/exe" : arguments.front(),
                   &actions, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  if (fault != 0)
    return -1;
  const Registered registered(child);
  int status = 0;
  if (waitpid(child, &status, 0) != child)
    return -1;
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

void pass_on_stops()
{
  std::signal(SIGINT, stop_programs);
  std::signal(SIGTERM, stop_programs);
}

bool are_programs_stopped()
{
  return is_stopped;
}
} // namespace spall
