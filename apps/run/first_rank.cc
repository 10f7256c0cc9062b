#include "run/first_rank.h"

#include "errors.h"

#include <dem/parallel/faults.h>

#include <array>
#include <stdexcept>

namespace spall
{
namespace
{
constexpr char of_input = 'i', of_run = 'r';

/// What `call` throws, after a letter for its kind; empty: nothing.
std::string fault_of(const std::function<void()> &call)
try
{
  call();
  return {};
}
catch (const InputError &error)
{
  return of_input + std::string(error.what());
}
catch (const std::invalid_argument &error)
{
  return of_input + std::string(error.what());
}
catch (const std::exception &error)
{
  return of_run + std::string(error.what());
}

/// Throws what the first rank with a fault has caught.
void throw_together(const dem::Ranks &ranks, const std::string &own)
{
  const std::string fault = dem::first_fault(ranks, own);
  if (fault.empty())
    return;
  if (fault.front() == of_input)
    throw InputError(fault.substr(1));
  throw RunFailure(fault.substr(1));
}
} // namespace

void on_first_rank(const dem::Ranks &ranks, const std::function<void()> &call)
{
  if (ranks.size() == 1)
    return call();
  throw_together(ranks, ranks.rank() == 0 ? fault_of(call) : std::string());
}

void on_every_rank(const dem::Ranks &ranks, const std::function<void()> &call)
{
  if (ranks.size() == 1)
    return call();
  throw_together(ranks, fault_of(call));
}

bool on_any_rank(const dem::Ranks &ranks, bool is_so)
{
  std::array any{is_so ? 1. : 0.};
  ranks.max(any);
  return any[0] > 0.;
}
} // namespace spall
