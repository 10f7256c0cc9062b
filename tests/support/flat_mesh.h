#pragma once

#include <fem/surface_mesh.h>

#include <random>

namespace support
{
/// n x n quads on the square [0, side]^2 in the plane z = 0, outside is +z.
inline fem::SurfaceMesh flat_square(double side, int n)
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

/// Nodes of flat_square on its rim.
inline std::vector<std::int32_t> square_rim(int n)
{
  std::vector<std::int32_t> rim;
  for (std::int32_t j = 0; j <= n; ++j)
    for (std::int32_t i = 0; i <= n; ++i)
      if (i == 0 || j == 0 || i == n || j == n)
        rim.push_back(j * (n + 1) + i);
  return rim;
}

/// The same nodes, each moved by up to `size` along every axis [m].
inline std::vector<Eigen::Vector3d> shaken(std::vector<Eigen::Vector3d> nodes,
                                           double size, unsigned int seed)
{
  std::mt19937 generator(seed);
  std::uniform_real_distribution<double> shift(-size, size);
  for (Eigen::Vector3d &node : nodes)
    for (int c = 0; c < 3; ++c)
      node(c) += shift(generator);
  return nodes;
}

/// Random vectors with components in [-size, size].
inline std::vector<Eigen::Vector3d> random_vectors(std::size_t n, double size,
                                                   unsigned int seed)
{
  return shaken(std::vector<Eigen::Vector3d>(n, Eigen::Vector3d::Zero()), size,
                seed);
}
} // namespace support
