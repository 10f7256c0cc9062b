#include "solid_operator.h"

#include <Eigen/Eigenvalues>

#include <cmath>
#include <map>

namespace fem
{
CellCorners corners_of(const SolidMesh &mesh, std::size_t cell)
{
  CellCorners corners;
  for (std::size_t v = 0; v < 8; ++v)
    corners[v] = mesh.nodes[static_cast<std::size_t>(mesh.cells[cell][v])];
  return corners;
}

ShapeKey shape_key(const CellCorners &corners, std::int32_t layer)
{
  const double size = (corners[7] - corners[0]).norm();
  const int exponent = std::ilogb(size);
  const double unit = std::ldexp(1e-9, exponent);
  ShapeKey key{};
  for (std::size_t v = 1; v < 8; ++v)
    for (int c = 0; c < 3; ++c)
      key[3 * (v - 1) + static_cast<std::size_t>(c)] =
          std::llround((corners[v](c) - corners[0](c)) / unit);
  key[21] = layer;
  key[22] = exponent;
  return key;
}

namespace
{
double largest_frequency(const CellMatrix &stiffness,
                         const std::array<double, 8> &mass)
{
  CellMatrix scaled = stiffness;
  for (Eigen::Index i = 0; i < 24; ++i)
    for (Eigen::Index j = 0; j < 24; ++j)
      scaled(i, j) /= std::sqrt(mass[static_cast<std::size_t>(i / 3)] *
                                mass[static_cast<std::size_t>(j / 3)]);
  const Eigen::SelfAdjointEigenSolver<CellMatrix> solver(
      scaled, Eigen::EigenvaluesOnly);
  return std::sqrt(solver.eigenvalues().maxCoeff());
}
} // namespace

SolidOperator::SolidOperator(const SolidMesh &mesh,
                             std::span<const SolidLayer> layers)
    : cells(mesh.cells), nodal_mass(mesh.nodes.size(), 0.),
      kernel(cell_kernels().front())
{
  build_matrices(mesh, layers);
  build_batches(mesh);
}

void SolidOperator::build_matrices(const SolidMesh &mesh,
                                   std::span<const SolidLayer> layers)
{
  std::map<ShapeKey, std::int32_t> known;
  for (std::size_t k = 0; k < cells.size(); ++k)
  {
    const CellCorners corners = corners_of(mesh, k);
    const SolidLayer &layer = layers[static_cast<std::size_t>(mesh.layer[k])];
    const std::array<double, 8> mass = cell_mass(corners, layer.density);
    for (std::size_t v = 0; v < 8; ++v)
      nodal_mass[static_cast<std::size_t>(cells[k][v])] += mass[v];

    const auto next = static_cast<std::int32_t>(matrices.size());
    const auto [entry, is_new] =
        known.emplace(shape_key(corners, mesh.layer[k]), next);
    matrix_of_cell.push_back(entry->second);
    if (!is_new)
      continue;
    matrices.push_back(cell_stiffness(corners, layer));
    const double frequency = largest_frequency(matrices.back(), mass);
    if (frequency > fastest.frequency)
      fastest = {frequency, k};
  }
}

void SolidOperator::build_batches(const SolidMesh &mesh)
{
  std::vector<std::vector<std::size_t>> of_matrix(matrices.size());
  for (std::size_t k = 0; k < mesh.cells.size(); ++k)
  {
    auto &waiting = of_matrix[static_cast<std::size_t>(matrix_of_cell[k])];
    waiting.push_back(k);
    if (waiting.size() < cell_lanes)
      continue;
    CellBatch &batch = batches.emplace_back();
    batch.stiffness = matrix_of_cell[k];
    for (std::size_t lane = 0; lane < cell_lanes; ++lane)
      for (std::size_t v = 0; v < 8; ++v)
        batch.node[v][lane] = cells[waiting[lane]][v];
    waiting.clear();
  }
  for (const auto &waiting : of_matrix)
    singles.insert(singles.end(), waiting.begin(), waiting.end());
}

void SolidOperator::multiply(std::span<const Eigen::Vector3d> u,
                             std::span<Eigen::Vector3d> out) const
{
  std::fill(out.begin(), out.end(), Eigen::Vector3d::Zero());
  for (const CellBatch &batch : batches)
    multiply_batch(batch, u, out);
  for (const std::size_t cell : singles)
    multiply_single(cell, u, out);
}

void SolidOperator::multiply_batch(const CellBatch &batch,
                                   std::span<const Eigen::Vector3d> u,
                                   std::span<Eigen::Vector3d> out) const
{
  alignas(64) double in[24][cell_lanes], force[24][cell_lanes];
  for (int v = 0; v < 8; ++v)
    for (int lane = 0; lane < cell_lanes; ++lane)
    {
      const auto &x = u[static_cast<std::size_t>(batch.node[v][lane])];
      for (int c = 0; c < 3; ++c)
        in[3 * v + c][lane] = x(c);
    }
  kernel(matrices[static_cast<std::size_t>(batch.stiffness)].data(), in, force);
  for (int lane = 0; lane < cell_lanes; ++lane)
    for (int v = 0; v < 8; ++v)
    {
      auto &to = out[static_cast<std::size_t>(batch.node[v][lane])];
      for (int c = 0; c < 3; ++c)
        to(c) += force[3 * v + c][lane];
    }
}

/// The matrix is symmetric: its rows serve as columns, which vectorise.
void SolidOperator::multiply_single(std::size_t cell,
                                    std::span<const Eigen::Vector3d> u,
                                    std::span<Eigen::Vector3d> out) const
{
  const double *matrix = stiffness(cell).data();
  double force[24] = {};
  for (std::size_t v = 0; v < 8; ++v)
    for (std::size_t c = 0; c < 3; ++c)
    {
      const double x = u[static_cast<std::size_t>(cells[cell][v])](
          static_cast<Eigen::Index>(c));
      const double *column = matrix + 24 * (3 * v + c);
      for (std::size_t i = 0; i < 24; ++i)
        force[i] += column[i] * x;
    }
  for (std::size_t v = 0; v < 8; ++v)
    out[static_cast<std::size_t>(cells[cell][v])] +=
        Eigen::Map<const Eigen::Vector3d>(force + 3 * v);
}
} // namespace fem
