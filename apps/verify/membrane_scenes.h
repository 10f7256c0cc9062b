#pragma once

#include <fem/membrane.h>

#include <functional>

namespace spall::verify
{
using NodalLoads = std::vector<Eigen::Vector3d>; // [N]

struct Relaxation
{
  double time_step = 0.; ///< [s]
  double duration = 0.;  ///< [s]
};

/// Advances the membrane; `set_loads` may fill the loads before each end_step.
void relax(fem::Membrane &membrane, const Relaxation &run,
           const std::function<void(NodalLoads &)> &set_loads = {});

/// n x n quads on the square [0, side]^2 in the plane z = 0, outside is +z.
fem::SurfaceMesh flat_square(double side, int n);

/// Nodes of flat_square on its rim.
std::vector<std::int32_t> square_rim(int n);
} // namespace spall::verify
