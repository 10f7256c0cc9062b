#pragma once

#include "solid_scene.h"

#include <cmath>
#include <cstddef>

/// A block of two layers for the tests of the solvers.
namespace support
{
/// Two layers, held below, on rollers at two sides, with dashpots at a third.
inline fem::Solid layered_block(const fem::SolidMesh &mesh,
                                fem::SolidSolver solver,
                                double tolerance = 1e-10)
{
  fem::SolidParameters p;
  p.layers.assign(2, {});
  p.layers[0] = {50e6, 0.3, 1800.};
  p.layers[1] = {200e6, 0.25, 2000.};
  p.stiffness_damping = 1e-4;
  p.solver = solver;
  p.solver_tolerance = tolerance;
  fem::Solid solid(p, mesh);
  solid.fix(fem::z_lower, {true, true, true});
  solid.fix(fem::x_lower, {true, false, false});
  solid.fix(fem::y_lower, {false, true, false});
  solid.absorb(fem::x_upper);
  return solid;
}

inline fem::SolidMesh layered_mesh(int n, bool is_refined)
{
  fem::BoxMesh box;
  for (auto &widths : box.widths)
    widths.assign(static_cast<std::size_t>(n), 1. / n);
  if (is_refined)
    box.refined.push_back(
        {Eigen::Vector3d(0., 0., 0.7), Eigen::Vector3d(0.5, 0.5, 1.), 1});
  fem::SolidMesh mesh = fem::box_mesh(box);
  const std::array<double, 2> tops{0.5, 1.};
  fem::assign_layers(mesh, tops);
  return mesh;
}

/// Loads under a disc on its top [N].
inline Vectors push(const fem::SolidMesh &mesh)
{
  return fem::traction_loads(
      mesh, fem::z_upper,
      [](const Eigen::Vector3d &x)
      {
        const bool is_under = std::hypot(x.x(), x.y()) < 0.5;
        return Eigen::Vector3d(0., 0., is_under ? -1e5 : 0.);
      });
}

/// Largest difference over the largest displacement.
inline double apart(const fem::Solid &a, const fem::Solid &b)
{
  double difference = 0., size = 0.;
  for (std::size_t k = 0; k < a.displacements().size(); ++k)
  {
    difference = std::max(difference,
                          (a.displacements()[k] - b.displacements()[k]).norm());
    size = std::max(size, a.displacements()[k].norm());
  }
  return difference / size;
}
} // namespace support
