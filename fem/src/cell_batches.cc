// Plain arrays only: what is compiled here for newer machines must not be
// shared with units that are compiled for all. Built with -ffp-contract=off,
// so that every width rounds alike.
#include "cell_batches.h"

#include <cstring>

namespace fem
{
namespace
{
#define FEM_INLINE [[gnu::always_inline]] inline

template <int lanes>
struct Pack
{
  typedef double type __attribute__((vector_size(8 * lanes)));
};

/// Four rows at a time, so that every displacement is loaded once for four.
template <typename Simd>
FEM_INLINE void four_rows(const double *matrix, const double (*in)[cell_lanes],
                          int lane, double (*out)[cell_lanes])
{
  Simd sum[4] = {};
  for (int j = 0; j < 24; ++j)
  {
    Simd x;
    std::memcpy(&x, &in[j][lane], sizeof(Simd));
    for (int r = 0; r < 4; ++r)
      sum[r] += matrix[24 * r + j] * x;
  }
  for (int r = 0; r < 4; ++r)
    std::memcpy(&out[r][lane], &sum[r], sizeof(Simd));
}

template <int lanes>
FEM_INLINE void multiply(const double *matrix, const double (*in)[cell_lanes],
                         double (*out)[cell_lanes])
{
  for (int lane = 0; lane < cell_lanes; lane += lanes)
    for (int i = 0; i < 24; i += 4)
      four_rows<typename Pack<lanes>::type>(matrix + 24 * i, in, lane, out + i);
}

void two_lanes(const double *matrix, const double (*in)[cell_lanes],
               double (*out)[cell_lanes])
{
  multiply<2>(matrix, in, out);
}

#if defined(__x86_64__)
[[gnu::target("avx2")]] void four_lanes(const double *matrix,
                                        const double (*in)[cell_lanes],
                                        double (*out)[cell_lanes])
{
  multiply<4>(matrix, in, out);
}

[[gnu::target("avx512f")]] void eight_lanes(const double *matrix,
                                            const double (*in)[cell_lanes],
                                            double (*out)[cell_lanes])
{
  multiply<8>(matrix, in, out);
}
#endif
} // namespace

std::vector<CellKernel> cell_kernels()
{
  std::vector<CellKernel> kernels;
#if defined(__x86_64__)
  if (__builtin_cpu_supports("avx512f"))
    kernels.push_back(eight_lanes);
  if (__builtin_cpu_supports("avx2"))
    kernels.push_back(four_lanes);
#endif
  kernels.push_back(two_lanes);
  return kernels;
}
} // namespace fem
