#pragma once

namespace dem
{
/// Whether a launcher such as mpirun or srun has started this process as a
/// rank. A process of its own that starts MPI pays for it in every step.
bool is_launched();

/// Ends all ranks at once with this status: for a failure of one of them.
[[noreturn]] void end_all_ranks(int status);

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
  /// Whether all ranks call this within so many seconds: whether a failure of
  /// this rank is one of all of them, so that one message is enough.
  bool all_arrive(double seconds) const;
  bool is_first() const; ///< this is rank 0

  MpiSession(const MpiSession &) = delete;
  MpiSession &operator=(const MpiSession &) = delete;

private:
  bool is_starter = false;
  int n_exceptions = 0; ///< that were under way when the object was made
};
} // namespace dem
