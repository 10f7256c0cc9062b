#include "check.h"

#include <dem/parallel/mpi_session.h>

#include <mpi.h>

#include <exception>
#include <stdexcept>
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
