#include "communicator.h"

#include "check.h"

namespace dem
{
Communicator::Communicator(MPI_Comm original, OnMpiFailure on_failure)
{
  check_mpi(MPI_Comm_dup(original, &communicator), "make a communicator");
  check_mpi(MPI_Comm_set_errhandler(communicator,
                                    on_failure == OnMpiFailure::return_code
                                        ? MPI_ERRORS_RETURN
                                        : MPI_ERRORS_ARE_FATAL),
            "set the handler of errors");
  check_mpi(MPI_Comm_rank(communicator, &own_rank), "tell the rank");
  check_mpi(MPI_Comm_size(communicator, &n_ranks), "count the ranks");
}

// Nobody can be told about a failure here, and none does harm.
Communicator::~Communicator()
{
  int is_over = 0;
  if (MPI_Finalized(&is_over) == MPI_SUCCESS && !is_over)
    MPI_Comm_free(&communicator);
}
} // namespace dem
