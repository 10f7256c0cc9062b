#pragma once

#include <dem/shape/particle_shape.h>
#include <dem/shape/spherical_harmonics.h>
#include <dem/triple.h>

namespace dem
{
/// A point of the surface x = r(s) s of a particle with the normal and the
/// shape operator there.
struct SurfacePoint
{
  Vec3 position = Vec3::Zero(); ///< from the centre of the particle [m]
  Vec3 normal = Vec3::UnitZ();  ///< outward [-]
  Mat3 shape_operator =
      Mat3::Zero(); ///< dn = shape_operator dx; positive if convex [1/m]
};

/// The surface at a unit direction of the body frame, exact.
SurfacePoint surface_point(const ParticleShape &body, const Vec3 &direction);

/// The surface where it was expanded (scale applied), in the body frame.
SurfacePoint surface_point(const RadialExpansion &at);

/// The same in the frame that `rotation` turns the body frame into.
SurfacePoint turned(const SurfacePoint &point, const Mat3 &rotation);

/// Pose of B relative to A, in the body frame of A.
struct RelativePose
{
  Vec3 position = Vec3::Zero();     ///< centre of B [m]
  Mat3 rotation = Mat3::Identity(); ///< body frame of B to that of A
};

/// A contact point: two surfaces have a common normal there, or nearly so.
struct ContactPoint
{
  Vec3 on_a = Vec3::UnitZ(); ///< unit direction in the body frame of A [-]
  Vec3 on_b = Vec3::UnitZ(); ///< of B [-]
  /// delta: along the normal, > 0 where the particles overlap [m]
  double overlap = 0.;
  bool is_found = false; ///< the search has converged to a lens of contact
};

/// Lenses deeper than this part of the radius are none: the common normal of
/// far sides of two particles.
inline constexpr double deepest_overlap = 0.3;

/// Follows the common normal of two particles (x_A - x_B = delta n, n_A = -n_B
/// = n) from a start by Newton steps with both shape operators, as long as a
/// lens T(y) = delta - y.(K_A + K_B) y / 2 needs it; once more by shorter steps
/// if they do not converge. Not found if there is no lens of positive curvature
/// near the start.
ContactPoint refine(const ParticleShape &a, const ParticleShape &b,
                    const RelativePose &pose, const ContactPoint &start);

/// A point of a particle that is farthest along a normal among its neighbours.
struct Support
{
  Vec3 direction = Vec3::UnitZ(); ///< unit, body frame [-]
  double height = 0.;             ///< along the normal, from the centre [m]
  bool is_found = false;
};

/// Refines to the support point along a unit vector of the body frame; once
/// more by steps for a flat one if it is not reached.
Support find_support(const ParticleShape &body, const Vec3 &normal,
                     const Vec3 &start);
} // namespace dem
