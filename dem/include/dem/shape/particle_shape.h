#pragma once

#include <dem/shape/quadrature.h>
#include <dem/shape/spherical_harmonics.h>

#include <memory>
#include <vector>

namespace dem
{
using Coefficients = std::vector<double>;

/// The shape of one particle, r = scale * sum a_j Y_j. Particles of one shape
/// share one row of coefficients until they break (copy on first break, scale
/// 1).
struct ParticleShape
{
  std::shared_ptr<const Coefficients> series; ///< a_j; null: a sphere
  double scale = 1.;  ///< [m] if the series is dimensionless, else [-]
  double volume = 0.; ///< [m^3]
  double inscribed_radius = 0.; ///< min of r over the quadrature nodes [m]
  /// r_ins that defines corners: the above, or of the largest sphere inside [m]
  double corner_radius = 0.;
  /// Bounds that hold in every direction, see radius_bounds().
  double circumscribed_radius = 0.; ///< r is nowhere larger [m]
  double least_radius = 0.;         ///< r is nowhere smaller [m]
  double max_slope = 0.;            ///< |grad_S r| is nowhere larger [m]
  /// Principal moments of inertia about the origin of the series over the mass
  /// [m^2], and the frame of their axes in the body frame.
  Vec3 gyration = Vec3::Zero();
  Quaternion principal = Quaternion::Identity();
};

/// A sphere of this radius [m].
ParticleShape make_sphere(double radius);

/// A particle of this shape whose equivalent radius a_00 / sqrt(4 pi) is
/// `radius` [m]. The series is shared, not copied. Integrates over the nodes
/// once (about 0.1 ms): for many particles of one shape use resized().
ParticleShape make_shape(std::shared_ptr<const Coefficients> series,
                         double radius,
                         const SphereQuadrature &rule = standard_quadrature());

/// The same shape with another equivalent radius [m]; costs nothing, the
/// integrals are scaled.
ParticleShape resized(const ParticleShape &body, double radius);

/// A particle of this shape with exactly these coefficients.
ParticleShape shape_of(Coefficients coefficients,
                       const SphereQuadrature &rule = standard_quadrature());

/// The same for a shape that differs little from one that is known (after an
/// event): its bounds are widened by the largest difference there can be. They
/// are computed again only when they become loose.
ParticleShape
changed_shape(const ParticleShape &before, Coefficients coefficients,
              const SphereQuadrature &rule = standard_quadrature());

/// Defines corners by the largest sphere inside the particle from now on.
void free_corner_radius(ParticleShape &body, const SphereQuadrature &rule);

/// a_00 / sqrt(4 pi) of the particle [m]; for a sphere its radius.
double mean_radius(const ParticleShape &body);

/// Coefficients of the particle itself, scale applied [m].
Coefficients scaled_coefficients(const ParticleShape &body);
} // namespace dem
