#include "check.h"

#include <dem/parallel/mpi_session.h>

#include <mpi.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdlib>
#include <exception>
#include <stdexcept>
#include <thread>
#include <zoltan.h>

namespace dem
{
namespace
{
void start_mpi()
{
  int level = 0;
  check_mpi(MPI_Init_thread(nullptr, nullptr, MPI_THREAD_FUNNELED, &level),
            "start");
  if (level < MPI_THREAD_FUNNELED)
    throw std::runtime_error("MPI: this library allows no threads: must have "
                             "MPI_THREAD_FUNNELED at least");
}
} // namespace

bool is_launched()
{
  return std::ranges::any_of(
      std::array{"OMPI_COMM_WORLD_SIZE", "PMIX_RANK", "PMI_RANK"},
      [](const char *name) { return std::getenv(name) != nullptr; });
}

void end_all_ranks(int status)
{
  MPI_Abort(MPI_COMM_WORLD, status);
  std::abort(); // never reached
}

MpiSession::MpiSession() : n_exceptions(std::uncaught_exceptions())
{
  int is_over = 0;
  check_mpi(MPI_Finalized(&is_over), "say whether it has ended");
  if (is_over)
    throw std::logic_error("MPI has ended and cannot start again");
  is_starter = !mpi_is_running();
  if (is_starter)
    start_mpi();
  float version = 0.f;
  check_zoltan(Zoltan_Initialize(0, nullptr, &version), "start");
}

bool MpiSession::all_arrive(double seconds) const
{
  MPI_Request request = MPI_REQUEST_NULL;
  check_mpi(MPI_Ibarrier(MPI_COMM_WORLD, &request), "wait for all ranks");
  const double end = MPI_Wtime() + seconds;
  int is_done = 0;
  while (!is_done && MPI_Wtime() < end)
  {
    check_mpi(MPI_Test(&request, &is_done, MPI_STATUS_IGNORE),
              "wait for all ranks");
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return is_done != 0;
}

bool MpiSession::is_first() const
{
  int rank = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  return rank == 0;
}

MpiSession::~MpiSession()
{
  int is_over = 0;
  if (!is_starter || MPI_Finalized(&is_over) != MPI_SUCCESS || is_over)
    return;
  int n_ranks = 1;
  MPI_Comm_size(MPI_COMM_WORLD, &n_ranks);
  if (n_ranks > 1 && std::uncaught_exceptions() > n_exceptions)
    MPI_Abort(MPI_COMM_WORLD, 1);
  MPI_Finalize();
}
} // namespace dem
