#pragma once

namespace dem
{
/// MPI and Zoltan run as long as this object lives. It starts MPI for one
/// thread of each process that communicates (MPI_THREAD_FUNNELED), with or
/// without mpirun; without it there is one rank. Where MPI runs already, as
/// under deal.II, it is left to whoever started it. Throws std::logic_error
/// where MPI has ended before: it cannot start twice.
///
/// An exception that leaves the scope of the object on one of several ranks
/// ends all of them with status 1, because the others would wait for that rank
/// for ever. To report it, catch it within the scope.
class MpiSession
{
public:
  MpiSession();
  ~MpiSession();
  MpiSession(const MpiSession &) = delete;
  MpiSession &operator=(const MpiSession &) = delete;

private:
  bool is_starter = false;
  int n_exceptions = 0; ///< that were under way when the object was made
};
} // namespace dem
