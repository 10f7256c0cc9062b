#include "stable_step.h"

#include <algorithm>
#include <cmath>
#include <random>

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

void scale(Field &field, std::span<const double> factor)
{
  for (std::size_t k = 0; k < field.size(); ++k)
    field[k] *= factor[k];
}

/// M^(-1/2), zero where a node is tied.
std::vector<double> inverse_root(const SheetInertia &inertia)
{
  std::vector<double> root(inertia.mass.size(), 0.);
  for (std::size_t k = 0; k < root.size(); ++k)
    if (!inertia.is_tied[k])
      root[k] = 1. / std::sqrt(inertia.mass[k]);
  return root;
}

/// Some of every mode, the same in every run.
Field start_vector(std::size_t n)
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
} // namespace

double largest_frequency(const Sheet &sheet, const SheetInertia &inertia,
                         std::span<const Eigen::Vector3d> positions,
                         double pressure)
{
  const std::vector<double> root = inverse_root(inertia);
  if (std::all_of(root.begin(), root.end(), [](double r) { return r == 0.; }))
    return 0.;
  Field direction = start_vector(positions.size()), scaled;
  Field image(positions.size());
  double eigenvalue = 0.;
  int n_still = 0;
  for (int step = 0; step < 2000 && n_still < 5; ++step)
  {
    scaled = direction;
    scale(scaled, root);
    apply_tangent(sheet, positions, pressure, scaled, image);
    scale(image, root);
    const double last = eigenvalue;
    eigenvalue = dot(direction, image) / dot(direction, direction);
    n_still =
        std::abs(eigenvalue - last) <= 1e-6 * eigenvalue ? n_still + 1 : 0;
    const double length = std::sqrt(dot(image, image));
    for (std::size_t k = 0; k < direction.size(); ++k)
      direction[k] = image[k] / length;
  }
  return std::sqrt(std::max(0., eigenvalue));
}
} // namespace fem
