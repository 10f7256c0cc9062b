#pragma once

#include "sheet_batches.h"
#include "sheet_material.h"

#include <Eigen/Dense>

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace fem
{
/// What one quadrature point needs of the reference surface.
struct SheetPoint
{
  /// Derivative of each shape function along two orthonormal tangents whose
  /// cross product is the outward normal [1/m].
  std::array<std::array<double, 2>, 4> gradient{};
  double weight = 0.; ///< reference area [m^2]
};

/// One quad with 2 x 2 Gauss points; `node` in the order of the shape
/// functions, not of the rim.
struct SheetElement
{
  std::array<std::int32_t, 4> node{};
  std::array<SheetPoint, 4> point{};
};

/// Value of shape function v at point q: the same for every element [-].
using ShapeValues = std::array<std::array<double, 4>, 4>;

struct Sheet
{
  SheetMaterial material;
  ShapeValues value{}; ///< value[q][v]
  std::vector<SheetElement> elements;
};

struct SheetForces;

/// The elements once more, in batches: for the forces of every step.
class BatchedSheet
{
public:
  explicit BatchedSheet(const Sheet &sheet);
  /// The same with another of batch_kernels().
  BatchedSheet(const Sheet &sheet, BatchKernel chosen);

private:
  friend void evaluate_forces(const BatchedSheet &,
                              std::span<const Eigen::Vector3d>, SheetForces &);
  std::vector<SheetBatch> batches;
  BatchLaw law;
  BatchKernel kernel;
};

/// Forces of the sheet on its nodes.
struct SheetForces
{
  std::vector<Eigen::Vector3d> internal; ///< -dW/dx [N]
  std::vector<Eigen::Vector3d> area;     ///< int N n da, n outward [m^2]
  double strain_energy = 0.;             ///< W [J]
};

/// With F_a = sum_v x_v dN_v/dX_a the Green-Lagrange strain is
/// E_ab = (F_a.F_b - delta_ab) / 2 and the force on node v
/// -int S_ab F_a dN_v/dX_b dA; the present area vector is F_1 x F_2 dA, so
/// 2 x 2 points are exact for `area`. The order of all sums is that of the
/// elements, so the result is the same on every machine.
void evaluate_forces(const BatchedSheet &sheet,
                     std::span<const Eigen::Vector3d> positions,
                     SheetForces &forces);

/// Derivative of -(internal - pressure area) along `direction`, times it:
/// material, tension and load stiffness [N].
void apply_tangent(const Sheet &sheet,
                   std::span<const Eigen::Vector3d> positions, double pressure,
                   std::span<const Eigen::Vector3d> direction,
                   std::span<Eigen::Vector3d> out);

/// The same derivative for one element as a matrix: row and column 3 v + i
/// belong to component i of its node v [N/m].
using SheetTangent = Eigen::Matrix<double, 12, 12>;
SheetTangent element_tangent(const Sheet &sheet, std::size_t element,
                             std::span<const Eigen::Vector3d> positions,
                             double pressure);

/// Mean size of the force of an element on one of its nodes [N].
double mean_element_force(const Sheet &sheet,
                          std::span<const Eigen::Vector3d> positions);

/// Averages over one element.
struct SheetState
{
  double area_ratio = 1.; ///< present over reference area [-]
  double tension = 0.;    ///< mean of the two Cauchy stresses, times h [N/m]
  double energy_density = 0.; ///< per reference area [J/m^2]
  double wrinkled = 0.;       ///< share of it where is_wrinkled() [-]
};
SheetState element_state(const Sheet &sheet, std::size_t element,
                         std::span<const Eigen::Vector3d> positions);

/// Share of the reference area where is_wrinkled() [-].
double wrinkled_share(const Sheet &sheet,
                      std::span<const Eigen::Vector3d> positions);

/// int h S_ab F_a (x) F_b dA: Cauchy stress over the volume of the sheet,
/// tension positive [J].
Eigen::Matrix3d stress_integral(const Sheet &sheet,
                                std::span<const Eigen::Vector3d> positions);
} // namespace fem
