#pragma once

#include <cstdint>
#include <vector>

namespace fem
{
/// Cells of one stiffness that are worked on together, one per lane.
constexpr int cell_lanes = 8;

struct CellBatch
{
  std::int32_t node[8][cell_lanes] = {};
  std::int32_t stiffness = 0; ///< number of the matrix they share
};

/// out[i][lane] = sum_j matrix[24 i + j] in[j][lane] for i, j below 24.
using CellKernel = void (*)(const double *matrix,
                            const double (*in)[cell_lanes],
                            double (*out)[cell_lanes]);

/// The same arithmetic, compiled for 2, 4 and 8 lanes: all give the same bits.
/// First the one that is used; only those that this machine can run.
std::vector<CellKernel> cell_kernels();
} // namespace fem
