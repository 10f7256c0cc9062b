#include "membrane_kernel.h"

#include <algorithm>

namespace fem
{
namespace
{
using Vector = Eigen::Vector3d;

/// The two tangents, or their change, at one point.
struct Tangents
{
  Vector first, second;
};

std::array<Vector, 4> gather(const SheetElement &element,
                             std::span<const Vector> field)
{
  std::array<Vector, 4> local;
  for (std::size_t v = 0; v < 4; ++v)
    local[v] = field[static_cast<std::size_t>(element.node[v])];
  return local;
}

Tangents tangents(const SheetPoint &point, const std::array<Vector, 4> &x)
{
  Tangents f{Vector::Zero(), Vector::Zero()};
  for (std::size_t v = 0; v < 4; ++v)
  {
    f.first += point.gradient[v][0] * x[v];
    f.second += point.gradient[v][1] * x[v];
  }
  return f;
}

Symmetric strain(const Tangents &f)
{
  return {0.5 * (f.first.squaredNorm() - 1.),
          0.5 * (f.second.squaredNorm() - 1.), 0.5 * f.first.dot(f.second)};
}

/// S_ab F_a for b = 1, 2.
Tangents flux(const Symmetric &s, const Tangents &f)
{
  return {s.xx * f.first + s.xy * f.second, s.xy * f.first + s.yy * f.second};
}

/// local_v += factor weight flux_b dN_v/dX_b
void add_divergence(const SheetPoint &point, const Tangents &p, double factor,
                    std::array<Vector, 4> &local)
{
  const Vector first = factor * point.weight * p.first;
  const Vector second = factor * point.weight * p.second;
  for (std::size_t v = 0; v < 4; ++v)
    local[v] += point.gradient[v][0] * first + point.gradient[v][1] * second;
}

void add_load(const std::array<double, 4> &value, const Vector &load,
              std::array<Vector, 4> &local)
{
  for (std::size_t v = 0; v < 4; ++v)
    local[v] += value[v] * load;
}

void scatter(const SheetElement &element, const std::array<Vector, 4> &local,
             std::span<Vector> field)
{
  for (std::size_t v = 0; v < 4; ++v)
    field[static_cast<std::size_t>(element.node[v])] += local[v];
}

void gather(const SheetBatch &batch, std::span<const Vector> positions,
            BatchPositions &local)
{
  for (int v = 0; v < 4; ++v)
    for (int lane = 0; lane < batch_size; ++lane)
    {
      const Vector &x =
          positions[static_cast<std::size_t>(batch.node[v][lane])];
      for (int i = 0; i < 3; ++i)
        local.x[v][i][lane] = x(i);
    }
}

void scatter(const SheetBatch &batch, const double (&local)[4][3][batch_size],
             std::vector<Vector> &field)
{
  for (int lane = 0; lane < batch.n_used; ++lane)
    for (int v = 0; v < 4; ++v)
    {
      Vector &to = field[static_cast<std::size_t>(batch.node[v][lane])];
      for (int i = 0; i < 3; ++i)
        to(i) += local[v][i][lane];
    }
}

std::array<Vector, 4> zeros()
{
  return {Vector::Zero(), Vector::Zero(), Vector::Zero(), Vector::Zero()};
}

} // namespace

BatchedSheet::BatchedSheet(const Sheet &sheet)
    : BatchedSheet(sheet, batch_kernels().front())
{
}

BatchedSheet::BatchedSheet(const Sheet &sheet, BatchKernel chosen)
    : kernel(chosen)
{
  law.stiffness = sheet.material.stiffness;
  law.poisson_ratio = sheet.material.poisson_ratio;
  law.is_neo_hookean = sheet.material.shear > 0.;
  law.shear = sheet.material.shear;
  law.tension = sheet.material.tension;
  law.has_wrinkles = sheet.material.has_wrinkles;
  law.residual = sheet.material.residual;
  law.line = tension_line(sheet.material);
  for (std::size_t q = 0; q < 4; ++q)
    std::copy(sheet.value[q].begin(), sheet.value[q].end(), law.value[q]);
  for (const SheetElement &element : sheet.elements)
  {
    if (batches.empty() || batches.back().n_used == batch_size)
      batches.emplace_back();
    SheetBatch &batch = batches.back();
    const int lane = batch.n_used++;
    for (std::size_t q = 0; q < 4; ++q)
    {
      batch.weight[q][lane] = element.point[q].weight;
      batch.node[q][lane] = element.node[q];
      for (std::size_t v = 0; v < 4; ++v)
        for (std::size_t a = 0; a < 2; ++a)
          batch.gradient[q][v][a][lane] = element.point[q].gradient[v][a];
    }
  }
}

void evaluate_forces(const BatchedSheet &sheet,
                     std::span<const Vector> positions, SheetForces &forces)
{
  forces.internal.assign(positions.size(), Vector::Zero());
  forces.area.assign(positions.size(), Vector::Zero());
  forces.strain_energy = 0.;
  BatchPositions local;
  BatchForces out;
  for (const SheetBatch &batch : sheet.batches)
  {
    gather(batch, positions, local);
    sheet.kernel(batch, sheet.law, local, out);
    for (int lane = 0; lane < batch.n_used; ++lane)
      forces.strain_energy += out.energy[lane];
    scatter(batch, out.internal, forces.internal);
    scatter(batch, out.area, forces.area);
  }
}

namespace
{
/// Of one element: the derivative along d at x.
std::array<Vector, 4>
local_tangent(const Sheet &sheet, const SheetElement &element, double pressure,
              const std::array<Vector, 4> &x, const std::array<Vector, 4> &d)
{
  std::array<Vector, 4> local = zeros();
  for (std::size_t q = 0; q < 4; ++q)
  {
    const SheetPoint &point = element.point[q];
    const Tangents f = tangents(point, x), df = tangents(point, d);
    const Symmetric e = strain(f);
    const Symmetric de{f.first.dot(df.first), f.second.dot(df.second),
                       0.5 * (f.first.dot(df.second) + f.second.dot(df.first))};
    add_divergence(point, flux(stress_change(sheet.material, e, de), f), 1.,
                   local);
    add_divergence(point, flux(stress(sheet.material, e), df), 1., local);
    add_load(sheet.value[q],
             pressure * point.weight *
                 (df.first.cross(f.second) + f.first.cross(df.second)),
             local);
  }
  return local;
}
} // namespace

void apply_tangent(const Sheet &sheet, std::span<const Vector> positions,
                   double pressure, std::span<const Vector> direction,
                   std::span<Vector> out)
{
  std::fill(out.begin(), out.end(), Vector::Zero());
  for (const SheetElement &element : sheet.elements)
    scatter(element,
            local_tangent(sheet, element, pressure, gather(element, positions),
                          gather(element, direction)),
            out);
}

SheetTangent element_tangent(const Sheet &sheet, std::size_t element,
                             std::span<const Vector> positions, double pressure)
{
  const SheetElement &quad = sheet.elements[element];
  const std::array<Vector, 4> x = gather(quad, positions);
  SheetTangent matrix;
  for (Eigen::Index column = 0; column < 12; ++column)
  {
    std::array<Vector, 4> unit = zeros();
    unit[static_cast<std::size_t>(column / 3)](column % 3) = 1.;
    const auto image = local_tangent(sheet, quad, pressure, x, unit);
    for (std::size_t v = 0; v < 4; ++v)
      matrix.block<3, 1>(3 * static_cast<Eigen::Index>(v), column) = image[v];
  }
  return matrix;
}

double mean_element_force(const Sheet &sheet, std::span<const Vector> positions)
{
  double sum = 0.;
  for (const SheetElement &element : sheet.elements)
  {
    const std::array<Vector, 4> x = gather(element, positions);
    std::array<Vector, 4> internal = zeros();
    for (const SheetPoint &point : element.point)
    {
      const Tangents f = tangents(point, x);
      const Symmetric s = stress(sheet.material, strain(f));
      add_divergence(point, flux(s, f), -1., internal);
    }
    for (const Vector &force : internal)
      sum += force.norm();
  }
  return sum / (4. * static_cast<double>(sheet.elements.size()));
}

SheetState element_state(const Sheet &sheet, std::size_t element,
                         std::span<const Vector> positions)
{
  const SheetElement &quad = sheet.elements[element];
  const std::array<Vector, 4> x = gather(quad, positions);
  double reference = 0., present = 0., trace = 0., energy = 0., wrinkled = 0.;
  for (const SheetPoint &point : quad.point)
  {
    const Tangents f = tangents(point, x);
    const Symmetric e = strain(f);
    const Symmetric s = stress(sheet.material, e);
    const Symmetric c = right_cauchy_green(e);
    reference += point.weight;
    present += point.weight * f.first.cross(f.second).norm();
    trace += point.weight * contract(s, c);
    energy += point.weight * energy_density(sheet.material, e);
    wrinkled += is_wrinkled(sheet.material, e) ? point.weight : 0.;
  }
  // tr(sigma) h da = S:C dA; a collapsed quad carries no tension.
  return {present / reference, present > 0. ? 0.5 * trace / present : 0.,
          energy / reference, wrinkled / reference};
}

double wrinkled_share(const Sheet &sheet, std::span<const Vector> positions)
{
  double wrinkled = 0., whole = 0.;
  for (const SheetElement &element : sheet.elements)
  {
    const std::array<Vector, 4> x = gather(element, positions);
    for (const SheetPoint &point : element.point)
    {
      whole += point.weight;
      if (is_wrinkled(sheet.material, strain(tangents(point, x))))
        wrinkled += point.weight;
    }
  }
  return wrinkled / whole;
}

Eigen::Matrix3d stress_integral(const Sheet &sheet,
                                std::span<const Vector> positions)
{
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  for (const SheetElement &element : sheet.elements)
  {
    const std::array<Vector, 4> x = gather(element, positions);
    for (const SheetPoint &point : element.point)
    {
      const Tangents f = tangents(point, x);
      const Tangents p = flux(stress(sheet.material, strain(f)), f);
      sum += point.weight *
             (p.first * f.first.transpose() + p.second * f.second.transpose());
    }
  }
  return sum;
}
} // namespace fem
