#pragma once

#include <dem/parameters/breakage.h>
#include <dem/parameters/material.h>
#include <dem/vector.h>

#include <vector>

namespace dem
{
/// Input of the engine besides the particles and boundaries.
struct EngineParameters
{
  ParticleMaterial particle;
  /// Of bodies that are no particles: material 1, 2, ... of
  /// Particles::material.
  std::vector<SolidMaterial> other_solids;
  WallMaterial wall;    ///< particles on planes
  WallMaterial surface; ///< particles on the facet surface
  GeometryParameters geometry;
  FrictionLimit friction_limit = FrictionLimit::elastic; ///< all contacts
  BreakageParameters breakage;
  Vec3 gravity = Vec3::Zero(); ///< [m/s^2]
  double local_damping = 0.;   ///< D_a [-]
  /// Particles of a smaller diameter are accelerated as if they had the mass of
  /// this one (particles/density_scaling.h); 0: none [m].
  double density_scaling_diameter = 0.;
};
} // namespace dem
