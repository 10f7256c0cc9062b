#pragma once

#include <dem/contact/narrow.h>
#include <dem/parameters/material.h>
#include <dem/shape/particle_shape.h>
#include <dem/shape/patch.h>

#include <array>
#include <cstdint>

namespace dem
{
/// Principal curvatures of a particle at a contact.
struct SideCurvature
{
  double first = 0.;                       ///< kappa_max, floored [1/m]
  double second = 0.;                      ///< kappa_min, floored [1/m]
  std::array<Narrow, 3> first_direction{}; ///< of kappa_max, body frame [-]
  std::int32_t is_corner = 0;              ///< g = 1 (Eq. 14, unfloored)

  double gaussian() const { return first * second; }
};

/// The surface of a particle about one direction.
struct SurfaceSide
{
  RadialExpansion expansion; ///< scale applied
  SideCurvature curvature;
};

/// Series and curvatures of the particle at a unit direction of its body frame;
/// both curvatures are floored at 1 / (floor_ratio r_ins) (breakage.md, Cap).
SurfaceSide evaluate_side(const ParticleShape &body, const Vec3 &direction,
                          double floor_ratio);
} // namespace dem
