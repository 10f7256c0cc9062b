// What a solid costs whose linear systems are spread over ranks:
//   mpirun -n R solid_ranks CELLS [STEPS]
// A cube of CELLS^3 cells in two layers, once at rest and then STEPS implicit
// steps of 1 ms (5). One line for the first rank: wall-clock seconds, the most
// memory of any rank, iterations, and the work of the load, which is to be
// compared between numbers of ranks.
#include "layered_block.h"

#include <dem/parallel/mpi_session.h>

#include <mpi.h>

#include <cstdio>
#include <cstdlib>
#include <sys/resource.h>

namespace
{
/// Most memory that this rank has had, of all ranks the largest [MB].
double peak_memory()
{
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  double peak = static_cast<double>(usage.ru_maxrss) / 1024.;
  MPI_Allreduce(MPI_IN_PLACE, &peak, 1, MPI_DOUBLE, MPI_MAX, MPI_COMM_WORLD);
  return peak;
}

double seconds()
{
  MPI_Barrier(MPI_COMM_WORLD);
  return MPI_Wtime();
}
} // namespace

int main(int argc, char **argv)
{
  if (argc < 2)
  {
    std::fprintf(stderr, "usage: solid_ranks CELLS [STEPS]\n");
    return 2;
  }
  const int n_cells = std::atoi(argv[1]);
  const int n_steps = argc > 2 ? std::atoi(argv[2]) : 5;
  const dem::MpiSession mpi;
  int n_ranks = 0;
  MPI_Comm_size(MPI_COMM_WORLD, &n_ranks);
  const fem::SolidMesh mesh = support::layered_mesh(n_cells, false);
  support::Vectors load = support::push(mesh);
  fem::Solid solid =
      support::layered_block(mesh, fem::SolidSolver::distributed_amg, 1e-10);
  const double before = peak_memory();
  const double start = seconds();
  solid.settle(load);
  const double rest = seconds() - start;
  const int at_rest = solid.solver_iterations();
  double first = 0., steps = 0.;
  for (int k = 0; k <= n_steps; ++k)
  {
    for (Eigen::Vector3d &force : load)
      force *= 1.1;
    const double begin = seconds();
    solid.advance(load, 1e-3);
    (k == 0 ? first : steps) += seconds() - begin;
  }
  const double peak = peak_memory();
  if (mpi.is_first())
    std::printf("ranks %d, unknowns %zu, at rest %.2f s (%d iterations), "
                "first step %.2f s, next %.3f s each (%d iterations), memory "
                "%.0f MB before and %.0f MB after, work %.12e J\n",
                n_ranks, 3 * mesh.nodes.size(), rest, at_rest, first,
                steps / n_steps, solid.solver_iterations(), before, peak,
                solid.energy().load_work);
}
