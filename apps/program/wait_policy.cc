#include "program/wait_policy.h"

#include <cstring>
#include <sched.h>
#include <unistd.h>

namespace spall
{
namespace
{
// Nothing here may need a library that has not been initialised yet: neither
// memory from the heap nor instrumented code.
#define SPALL_EARLY __attribute__((no_sanitize("address", "undefined")))

constexpr const char *policies[] = {
    "OMP_WAIT_POLICY=", "GOMP_SPINCOUNT=", "KMP_BLOCKTIME="};

SPALL_EARLY bool begins_with(const char *text, const char *start)
{
  while (*start != '\0')
    if (*text++ != *start++)
      return false;
  return true;
}

SPALL_EARLY bool is_equal(const char *a, const char *b)
{
  return begins_with(a, b) && begins_with(b, a);
}

/// Whether the command is a run, on more than one thread.
SPALL_EARLY bool may_have_threads(int n_words, char **words)
{
  if (n_words < 2 || !is_equal(words[1], "run"))
    return false;
  for (int k = 2; k + 1 < n_words; ++k)
    if (is_equal(words[k], "--threads") && is_equal(words[k + 1], "1"))
      return false;
  cpu_set_t cores;
  return sched_getaffinity(0, sizeof cores, &cores) != 0 ||
         CPU_COUNT(&cores) > 1;
}

/// If the start fails, the run continues with the policy of the library.
SPALL_EARLY void set_wait_policy(int n_words, char **words, char **environment)
{
  if (!may_have_threads(n_words, words))
    return;
  constexpr int most = 4096;
  const char *with_policy[most + 2];
  int n = 0;
  for (; environment[n] && n < most; ++n)
  {
    for (const char *policy : policies)
      if (begins_with(environment[n], policy))
        return;
    with_policy[n] = environment[n];
  }
  if (n == most)
    return;
  with_policy[n] = spin_count;
  with_policy[n + 1] = nullptr;
  execve("/proc/self/exe", words, const_cast<char **>(with_policy));
}

using EarlyFunction = void (*)(int, char **, char **);
__attribute__((section(".preinit_array"), used)) EarlyFunction early =
    set_wait_policy;
} // namespace

void apply_wait_policy() {}
} // namespace spall
