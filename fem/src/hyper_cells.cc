#include "hyper_cells.h"

#include <map>

namespace fem
{
namespace
{
using Matrix = Eigen::Matrix3d;
using CellVector = Eigen::Matrix<double, 24, 1>;
using CellField = Eigen::Matrix<double, 8, 3, Eigen::RowMajor>;

CellField gather(std::span<const Eigen::Vector3d> u,
                 const std::array<std::int32_t, 8> &nodes)
{
  CellField field;
  for (std::size_t v = 0; v < 8; ++v)
    field.row(static_cast<Eigen::Index>(v)) =
        u[static_cast<std::size_t>(nodes[v])];
  return field;
}

/// J F^(-T), how the volume changes with F.
Matrix cofactor(const Matrix &f)
{
  return f.determinant() * f.inverse().transpose();
}

/// Derivative of that along a change of F.
Matrix cofactor_change(const Matrix &f, const Matrix &change)
{
  const Matrix inverse = f.inverse().transpose();
  return f.determinant() * ((inverse.array() * change.array()).sum() * inverse -
                            inverse * change.transpose() * inverse);
}
} // namespace

/// Deformation of the points, mean ratio of volumes, and what follows.
struct HyperCells::Response
{
  std::array<Matrix, 8> deformation;
  double volume = 0.;                    ///< before [m^3]
  double ratio = 0.;                     ///< J of the cell [-]
  CellField moved;                       ///< u [m]
  CellField opening = CellField::Zero(); ///< dv / du [m^2]
  CellField force = CellField::Zero();   ///< [N]
  double energy = 0.;                    ///< [J]
};

HyperCells::HyperCells(const SolidMesh &mesh,
                       std::span<const SolidLayer> layers)
    : entry(mesh.cells.size(), -1)
{
  std::map<ShapeKey, std::size_t> known;
  for (std::size_t k = 0; k < mesh.cells.size(); ++k)
  {
    const SolidLayer &layer = layers[static_cast<std::size_t>(mesh.layer[k])];
    if (layer.law != SolidLaw::neo_hooke)
      continue;
    const CellCorners corners = corners_of(mesh, k);
    const auto [shape, is_new] =
        known.emplace(shape_key(corners, mesh.layer[k]), shapes.size());
    if (is_new)
      shapes.push_back(
          {point_gradients(corners), cell_stiffness(corners, layer)});
    const double nu = layer.poisson_ratio;
    entry[k] = static_cast<std::int32_t>(cells.size());
    cells.push_back({k,
                     mesh.cells[k],
                     shape->second,
                     {layer.youngs_modulus / (2. * (1. + nu)),
                      layer.youngs_modulus / (3. * (1. - 2. * nu))}});
  }
}

HyperCells::Response
HyperCells::respond(const Cell &cell, std::span<const Eigen::Vector3d> u) const
{
  const PointGradients &points = shapes[cell.points].points;
  Response r;
  r.moved = gather(u, cell.nodes);
  double now = 0.;
  for (std::size_t q = 0; q < 8; ++q)
  {
    const double w = points.volume[q];
    Matrix &f = r.deformation[q];
    f = Matrix::Identity() + r.moved.transpose() * points.gradient[q];
    r.volume += w;
    now += w * f.determinant();
    r.opening += w * points.gradient[q] * cofactor(f).transpose();
    r.force += w * points.gradient[q] * shape_stress(cell.law, f).transpose();
    r.energy += w * shape_energy(cell.law, f);
  }
  r.ratio = now / r.volume;
  r.force += volume_stress(cell.law, r.ratio) * r.opening;
  r.energy += r.volume * volume_energy(cell.law, r.ratio);
  return r;
}

void HyperCells::relieve(std::span<const Eigen::Vector3d> u,
                         std::span<Eigen::Vector3d> force) const
{
  for (const Cell &cell : cells)
  {
    const Response r = respond(cell, u);
    const CellVector linear = shapes[cell.points].stiffness *
                              Eigen::Map<const CellVector>(r.moved.data());
    const CellVector more =
        linear - Eigen::Map<const CellVector>(r.force.data());
    for (std::size_t v = 0; v < 8; ++v)
      force[static_cast<std::size_t>(cell.nodes[v])] +=
          more.segment<3>(3 * static_cast<Eigen::Index>(v));
  }
}

void HyperCells::soften(std::span<const Eigen::Vector3d> u,
                        std::vector<CellChange> &changes) const
{
  for (const Cell &cell : cells)
  {
    const Response r = respond(cell, u);
    const PointGradients &points = shapes[cell.points].points;
    const double pressure = volume_stress(cell.law, r.ratio);
    CellMatrix tangent = -shapes[cell.points].stiffness;
    for (Eigen::Index j = 0; j < 24; ++j)
    {
      CellField column = volume_stiffness(cell.law, r.ratio) / r.volume *
                         r.opening(j / 3, j % 3) * r.opening;
      for (std::size_t q = 0; q < 8; ++q)
      {
        Matrix change = Matrix::Zero();
        change.row(j % 3) = points.gradient[q].row(j / 3);
        const Matrix &f = r.deformation[q];
        column += points.volume[q] * points.gradient[q] *
                  (shape_stress_change(cell.law, f, change) +
                   pressure * cofactor_change(f, change))
                      .transpose();
      }
      tangent.col(j) += Eigen::Map<const CellVector>(column.data());
    }
    changes.push_back({cell.number, tangent});
  }
}

double HyperCells::stored_beyond(std::span<const Eigen::Vector3d> u) const
{
  double sum = 0.;
  for (const Cell &cell : cells)
  {
    const Response r = respond(cell, u);
    sum += r.energy - 0.5 * (r.moved.array() * r.force.array()).sum();
  }
  return sum;
}

std::optional<Voigt>
HyperCells::mean_stress(std::size_t cell,
                        std::span<const Eigen::Vector3d> u) const
{
  if (entry[cell] < 0)
    return std::nullopt;
  const Cell &it = cells[static_cast<std::size_t>(entry[cell])];
  const Response r = respond(it, u);
  Matrix sum = Matrix::Zero();
  for (std::size_t q = 0; q < 8; ++q)
    sum += shapes[it.points].points.volume[q] *
           shape_stress(it.law, r.deformation[q]) *
           r.deformation[q].transpose();
  sum = sum / (r.ratio * r.volume) +
        volume_stress(it.law, r.ratio) * Matrix::Identity();
  Voigt stress;
  stress << sum(0, 0), sum(1, 1), sum(2, 2), sum(1, 2), sum(2, 0), sum(0, 1);
  return stress;
}
} // namespace fem
