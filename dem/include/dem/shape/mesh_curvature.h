#pragma once

#include <dem/shape/fit.h>

#include <span>
#include <vector>

namespace dem
{
/// Principal curvatures of a mesh at one of its points, positive where convex.
struct PointCurvature
{
  double maximum = 0.; ///< kappa_max, algebraic order [1/m]
  double minimum = 0.; ///< kappa_min [1/m]
};

/// Curvatures of a closed mesh whose triangles are counter-clockwise from
/// outside. Around each point the quadratic patch
///   z = a + b x + c y + d x y + e x^2 + h y^2
/// is fitted by least squares (article, Eq. 11) in a frame whose z is the
/// normal of the point, the mean of those of its triangles by area. The
/// curvatures are the eigenvalues of I^-1 II with
///   I = [1 + b^2, b c; b c, 1 + c^2],
///   II = -[2 e, d; d, 2 h] / sqrt(1 + b^2 + c^2);
/// those of the article, the eigenvalues of the second derivatives alone, are
/// the same where the slope b, c is zero.
///
/// The patch has the points that edges connect within `radius` [m] of the
/// point, and at least those of two rings of edges.
std::vector<PointCurvature> mesh_curvatures(const TriangleMesh &mesh,
                                            double radius);

/// A third of the area of its triangles for each point; the sum is the area of
/// the mesh [m^2].
std::vector<double> point_areas(const TriangleMesh &mesh);

/// A point of a mesh beside the series in its direction.
struct ComparedPoint
{
  Vec3 direction = Vec3::UnitZ(); ///< from the centroid, unit [-]
  double area = 0.;               ///< share of the mesh [m^2]
  double radius_mesh = 0.;        ///< from the centroid [m]
  double radius_series = 0.;      ///< [m]
  double curvature_mesh = 0.;     ///< kappa_max [1/m]
  double curvature_series = 0.;   ///< kappa_max [1/m]
  bool is_mesh_corner = false;    ///< g(kappa) of Eq. 14
  bool is_series_corner = false;
};

/// Largest curvature and corners of a mesh and of a series.
struct CornerComparison
{
  std::vector<ComparedPoint> points; ///< of the mesh, welded
  double patch_radius = 0.;          ///< of mesh_curvatures() [m]
  double edge_length = 0.;           ///< mean over the mesh [m]
  double inscribed_mesh = 0.;        ///< smallest radius of its points [m]
  double inscribed_series = 0.;      ///< smallest radius of the nodes [m]
  double agreement = 0.;             ///< share of the area, equal g [-]
  double corners_mesh = 0.;          ///< share of the area, g = 1 [-]
  double corners_series = 0.;        ///< the same of the series [-]
  double corners_both = 0.;          ///< the same of both [-]
  /// Median over the area of |kappa_series - kappa_mesh| r_ins [-].
  double median_difference = 0.;
  double residual_rms = 0.; ///< of the radius / mean radius [-]
};

/// Compares at the points of the mesh, seen from the centroid of its volume:
/// a series of fit_shape() has its origin there. A point is a corner where
/// kappa_max r_ins > 1 + 1e-3, each with its own inscribed radius. The patch
/// has `patch` times the mean radius of the series [-]. Throws
/// std::invalid_argument as fit_shape() does for a mesh that is no closed body.
CornerComparison compare_corners(const TriangleMesh &mesh,
                                 std::span<const double> series, double patch);
} // namespace dem
