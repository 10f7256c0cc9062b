// The main function of tests that run on several ranks. The first failure on
// any rank ends all of them: the others would wait for that rank for ever.
#include <dem/parallel/mpi_session.h>

#include <gtest/gtest.h>
#include <mpi.h>

#include <cstdio>

namespace
{
class EndOnFailure : public testing::EmptyTestEventListener
{
public:
  explicit EndOnFailure(int own_rank) : rank(own_rank) {}

private:
  void OnTestPartResult(const testing::TestPartResult &result) override
  {
    if (!result.failed())
      return;
    std::fprintf(stderr, "rank %d: %s:%d: %s\n", rank,
                 result.file_name() ? result.file_name() : "unknown file",
                 result.line_number(), result.message());
    std::fflush(nullptr);
    MPI_Abort(MPI_COMM_WORLD, 1);
  }

  const int rank;
};
} // namespace

int main(int argc, char **argv)
{
  const dem::MpiSession mpi;
  testing::InitGoogleTest(&argc, argv);
  int rank = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  testing::TestEventListeners &listeners =
      testing::UnitTest::GetInstance()->listeners();
  if (rank > 0)
    delete listeners.Release(listeners.default_result_printer());
  listeners.Append(new EndOnFailure(rank));
  return RUN_ALL_TESTS();
}
