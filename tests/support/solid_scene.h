#pragma once

#include <fem/solid_surface.h>

#include <cmath>

/// Small bodies for the tests of the solid.
namespace support
{
using Vectors = std::vector<Eigen::Vector3d>;

inline Vectors no_loads(const fem::Solid &solid)
{
  return Vectors(solid.mesh().nodes.size(), Eigen::Vector3d::Zero());
}

/// Box at the origin with n[c] equal cells along each side [m].
inline fem::SolidMesh box(const Eigen::Vector3d &size,
                          const std::array<int, 3> &n)
{
  fem::BoxMesh box;
  for (std::size_t c = 0; c < 3; ++c)
    box.widths[c].assign(static_cast<std::size_t>(n[c]),
                         size(static_cast<Eigen::Index>(c)) / n[c]);
  return fem::box_mesh(box);
}

/// Held below, and across on all four sides.
inline void stand_between_smooth_sides(fem::Solid &solid)
{
  solid.fix(fem::z_lower, {true, true, true});
  for (const auto side : {fem::x_lower, fem::x_upper})
    solid.fix(side, {true, false, false});
  for (const auto side : {fem::y_lower, fem::y_upper})
    solid.fix(side, {false, true, false});
}

/// A quarter of a half-space below z = 0: two planes of symmetry, far sides
/// that absorb.
inline void stand_in_a_half_space(fem::Solid &solid)
{
  solid.fix(fem::x_lower, {true, false, false});
  solid.fix(fem::y_lower, {false, true, false});
  solid.absorb(fem::x_upper);
  solid.absorb(fem::z_lower);
}

/// The node at this position; -1 if there is none.
inline std::int32_t node_at(const fem::SolidMesh &mesh,
                            const Eigen::Vector3d &position)
{
  for (std::size_t k = 0; k < mesh.nodes.size(); ++k)
    if ((mesh.nodes[k] - position).norm() < 1e-9 * (1. + position.norm()))
      return static_cast<std::int32_t>(k);
  return -1;
}

inline double balance(const fem::SolidEnergy &e)
{
  return e.strain + e.kinetic + e.damping + e.plastic + e.absorbed -
         e.load_work - e.support_work;
}

/// A field of displacements without body forces: point load P on the surface
/// z = 0 of a half-space below it, pushing down (Boussinesq 1885).
struct PointLoad
{
  double force = 0.; ///< P [N]
  fem::SolidLayer layer;

  Eigen::Vector3d operator()(const Eigen::Vector3d &x) const
  {
    const double nu = layer.poisson_ratio;
    const double shear = layer.youngs_modulus / (2. * (1. + nu));
    const double depth = -x.z(), radius = x.norm();
    const double across = std::hypot(x.x(), x.y());
    const double scale = force / (4. * M_PI * shear);
    const double outward =
        scale * (across * depth / std::pow(radius, 3) -
                 (1. - 2. * nu) * across / (radius * (radius + depth)));
    const double down =
        scale * (2. * (1. - nu) / radius + depth * depth / std::pow(radius, 3));
    const double share = across > 0. ? outward / across : 0.;
    return {share * x.x(), share * x.y(), -down};
  }
};
} // namespace support
