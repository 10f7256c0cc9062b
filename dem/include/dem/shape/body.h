#pragma once

#include <dem/shape/quadrature.h>
#include <dem/shape/spherical_harmonics.h>

#include <memory>
#include <vector>

namespace dem
{
using Coefficients = std::vector<double>;

/// The shape of one stone, r = scale * sum a_j Y_j. Stones of one shape share
/// one row of coefficients until they break (copy on first break, scale 1).
struct Body
{
  std::shared_ptr<const Coefficients> series; ///< a_j; null: a sphere
  double scale = 1.;  ///< [m] if the series is dimensionless, else [-]
  double volume = 0.; ///< [m^3]
  double inscribed_radius = 0.; ///< min of r over the quadrature nodes [m]
  /// r_ins that tells corners: the above, or of the largest sphere inside [m]
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
Body make_sphere(double radius);

/// A stone of this shape whose ball radius a_00 / sqrt(4 pi) is `radius` [m].
/// The series is shared, not copied. Integrates over the nodes once (about
/// 0.1 ms): for many stones of one shape use resized().
Body make_body(std::shared_ptr<const Coefficients> series, double radius,
               const SphereQuadrature &rule = standard_quadrature());

/// The same shape with another ball radius [m]; costs nothing, the integrals
/// are scaled.
Body resized(const Body &body, double radius);

/// A particle of this shape with exactly these coefficients.
Body own_body(Coefficients coefficients,
              const SphereQuadrature &rule = standard_quadrature());

/// The same for a shape that differs little from one that is known (after an
/// event): its bounds are widened by the largest difference there can be. They
/// are computed again only when they become loose.
Body changed_body(const Body &before, Coefficients coefficients,
                  const SphereQuadrature &rule = standard_quadrature());

/// Tells corners by the largest sphere inside the stone from now on.
void free_corner_radius(Body &body, const SphereQuadrature &rule);

/// a_00 / sqrt(4 pi) of the stone [m]; for a sphere its radius.
double mean_radius(const Body &body);

/// Coefficients of the stone itself, scale applied [m].
Coefficients scaled_coefficients(const Body &body);
} // namespace dem
