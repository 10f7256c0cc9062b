#pragma once

#include <dem/parallel/ranks.h>

#include <memory>

namespace dem
{
/// All processes of MPI_COMM_WORLD. Space is divided by recursive coordinate
/// bisection, and messages are planned, by Zoltan. Throws std::logic_error
/// where MPI is not running (dem/parallel/mpi_session.h starts it). Failures of
/// MPI and Zoltan throw std::runtime_error. This function and the destruction
/// of what it returns are collective.
std::shared_ptr<Ranks> mpi_ranks();

/// mpi_ranks() where MPI is running on several ranks, else one_rank().
std::shared_ptr<Ranks> ranks_of_program();
} // namespace dem
