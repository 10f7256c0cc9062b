#include "stable_step.h"

#include "membrane_motion.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <utility>

namespace fem
{
namespace
{
using Field = std::vector<Eigen::Vector3d>;

double dot(const Field &a, const Field &b)
{
  double sum = 0.;
  for (std::size_t k = 0; k < a.size(); ++k)
    sum += a[k].dot(b[k]);
  return sum;
}

/// M^(-1/2), zero where and along which axes a node does not move by itself.
Field inverse_root(const SheetInertia &inertia)
{
  Field root(inertia.mass.size(), Eigen::Vector3d::Zero());
  for (std::size_t k = 0; k < root.size(); ++k)
    if (!inertia.midpoints.is_hanging(k))
      root[k] =
          free_part(inertia.tied[k],
                    Eigen::Vector3d::Constant(1. / std::sqrt(inertia.mass[k])));
  return root;
}

/// Entries of the tridiagonal matrix of the Lanczos iteration so far.
struct Tridiagonal
{
  std::vector<double> diagonal, beside;

  double largest_eigenvalue() const
  {
    const auto n = static_cast<Eigen::Index>(diagonal.size());
    Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver;
    solver.computeFromTridiagonal(
        Eigen::Map<const Eigen::VectorXd>(diagonal.data(), n),
        Eigen::Map<const Eigen::VectorXd>(beside.data(), n - 1),
        Eigen::EigenvaluesOnly);
    return solver.eigenvalues().maxCoeff();
  }
};

} // namespace

Field start_field(std::size_t n)
{
  std::mt19937 generator(1);
  const auto number = [&generator]
  { return static_cast<double>(generator()) / generator.max() - 0.5; };
  Field field(n);
  for (Eigen::Vector3d &entry : field)
    for (int c = 0; c < 3; ++c)
      entry(c) = number();
  return field;
}

/// Without orthogonalisation: copies of an eigenvalue do no harm to the
/// largest one.
double largest_eigenvalue(const FieldOperator &apply, Field direction)
{
  Tridiagonal matrix;
  Field before(direction.size(), Eigen::Vector3d::Zero());
  double length = std::sqrt(dot(direction, direction)), eigenvalue = 0.;
  int n_still = 0;
  for (int step = 0; step < 300 && n_still < 5 && length > 0.; ++step)
  {
    const double coupling = step == 0 ? 0. : length;
    if (step > 0)
      matrix.beside.push_back(coupling);
    for (Eigen::Vector3d &entry : direction)
      entry /= length;
    Field image = apply(direction);
    matrix.diagonal.push_back(dot(direction, image));
    for (std::size_t k = 0; k < image.size(); ++k)
      image[k] -= matrix.diagonal.back() * direction[k] + coupling * before[k];
    before = std::exchange(direction, std::move(image));
    length = std::sqrt(dot(direction, direction));

    const double last = std::exchange(eigenvalue, matrix.largest_eigenvalue());
    const bool is_still = std::abs(eigenvalue - last) <= 1e-6 * eigenvalue;
    n_still = is_still ? n_still + 1 : 0;
  }
  return eigenvalue;
}

double largest_frequency(const Sheet &sheet, const SheetInertia &inertia,
                         std::span<const Eigen::Vector3d> positions,
                         double pressure)
{
  const Field root = inverse_root(inertia);
  const auto scale = [&root](Field &field)
  {
    for (std::size_t k = 0; k < field.size(); ++k)
      field[k] = field[k].cwiseProduct(root[k]);
  };
  const auto apply = [&](Field direction)
  {
    Field image(direction.size());
    scale(direction);
    inertia.midpoints.spread(direction);
    apply_tangent(sheet, positions, pressure, direction, image);
    inertia.midpoints.collect(image);
    scale(image);
    return image;
  };
  Field start = start_field(positions.size());
  scale(start); // nothing on nodes that do not move by themselves
  return std::sqrt(std::max(0., largest_eigenvalue(apply, start)));
}
} // namespace fem
