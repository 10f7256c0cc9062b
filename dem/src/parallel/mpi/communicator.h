#pragma once

#include <mpi.h>

namespace dem
{
/// What a failure of MPI does. Zoltan does not look at the codes of MPI: there
/// a failure must end the program.
enum class OnMpiFailure
{
  return_code,
  end_program
};

/// The ranks of another communicator, whose messages meet no others. Making
/// and destroying one is collective.
class Communicator
{
public:
  Communicator(MPI_Comm original, OnMpiFailure on_failure);
  ~Communicator();
  Communicator(const Communicator &) = delete;
  Communicator &operator=(const Communicator &) = delete;

  MPI_Comm get() const { return communicator; }
  int rank() const { return own_rank; }
  int size() const { return n_ranks; }

private:
  MPI_Comm communicator = MPI_COMM_NULL;
  int own_rank = 0;
  int n_ranks = 0;
};
} // namespace dem
