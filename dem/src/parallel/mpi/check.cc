#include "check.h"

#include <mpi.h>

#include <stdexcept>
#include <string>
#include <zoltan.h>

namespace dem
{
void check_mpi(int code, const char *action)
{
  if (code == MPI_SUCCESS)
    return;
  std::string reason(MPI_MAX_ERROR_STRING, '\0');
  int length = 0;
  if (MPI_Error_string(code, reason.data(), &length) != MPI_SUCCESS)
    length = 0;
  reason.resize(static_cast<std::size_t>(length));
  throw std::runtime_error("MPI failed to " + std::string(action) + ": " +
                           reason);
}

void check_zoltan(int code, const char *action)
{
  if (code != ZOLTAN_OK && code != ZOLTAN_WARN)
    throw std::runtime_error("Zoltan failed to " + std::string(action) +
                             ": error " + std::to_string(code));
}

bool mpi_is_running()
{
  int is_running = 0, is_over = 0;
  check_mpi(MPI_Initialized(&is_running), "say whether it runs");
  check_mpi(MPI_Finalized(&is_over), "say whether it has ended");
  return is_running && !is_over;
}
} // namespace dem
