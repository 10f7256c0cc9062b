#pragma once

#include "sheet_material.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace fem
{
/// Elements that are worked on together, entry k of each row is element k.
constexpr int batch_size = 8;

/// Geometry of batch_size elements as flat rows. Rows that are left over have
/// weight zero and point to node 0.
struct alignas(64) SheetBatch
{
  double gradient[4][4][2][batch_size] = {}; ///< [point][node][direction] [1/m]
  double weight[4][batch_size] = {};         ///< reference area [m^2]
  std::int32_t node[4][batch_size] = {};
  int n_used = 0;
};

/// See SheetMaterial.
struct BatchLaw
{
  bool is_neo_hookean = false;
  double stiffness = 0.;     ///< c [N/m]
  double poisson_ratio = 0.; ///< nu [-]
  double shear = 0.;         ///< mu h [N/m]
  double tension = 0.;       ///< T [N/m]
  bool has_wrinkles = false;
  double residual = 0.; ///< r [-]
  TensionLine line;
  double value[4][4] = {}; ///< of the shape functions, [point][node] [-]
};

/// Per element: what evaluate_forces adds up.
struct alignas(64) BatchForces
{
  double internal[4][3][batch_size]; ///< [N]
  double area[4][3][batch_size];     ///< [m^2]
  double energy[batch_size];         ///< [J]
};

/// Positions of the nodes of a batch [m].
struct alignas(64) BatchPositions
{
  double x[4][3][batch_size];
};

using BatchKernel = void (*)(const SheetBatch &, const BatchLaw &,
                             const BatchPositions &, BatchForces &);

/// The same arithmetic, compiled for 2, 4 and 8 lanes: all give the same bits.
/// First the one that is used; only those that this machine can run.
std::vector<BatchKernel> batch_kernels();
} // namespace fem
