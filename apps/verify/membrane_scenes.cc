#include "membrane_scenes.h"

namespace spall::verify
{
void relax(fem::Membrane &membrane, const Relaxation &run,
           const std::function<void(NodalLoads &)> &set_loads)
{
  NodalLoads loads(membrane.n_nodes(), Eigen::Vector3d::Zero());
  const auto n_steps = static_cast<int>(run.duration / run.time_step + 0.5);
  for (int step = 0; step < n_steps; ++step)
  {
    membrane.begin_step(run.time_step);
    if (set_loads)
      set_loads(loads);
    membrane.end_step(loads, run.time_step);
  }
}

fem::SurfaceMesh flat_square(double side, int n)
{
  fem::SurfaceMesh mesh;
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i)
      mesh.nodes.emplace_back(side * i / n, side * j / n, 0.);
  for (std::int32_t j = 0; j < n; ++j)
    for (std::int32_t i = 0; i < n; ++i)
    {
      const std::int32_t low = j * (n + 1) + i, high = low + n + 1;
      mesh.quads.push_back({low, low + 1, high + 1, high});
    }
  return mesh;
}

std::vector<std::int32_t> square_rim(int n)
{
  std::vector<std::int32_t> rim;
  for (std::int32_t j = 0; j <= n; ++j)
    for (std::int32_t i = 0; i <= n; ++i)
      if (i == 0 || j == 0 || i == n || j == n)
        rim.push_back(j * (n + 1) + i);
  return rim;
}
} // namespace spall::verify
