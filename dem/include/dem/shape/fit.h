#pragma once

#include <dem/vector.h>

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

namespace dem
{
struct TriangleMesh
{
  std::vector<Vec3> points;                           ///< [m]
  std::vector<std::array<std::int32_t, 3>> triangles; ///< point numbers
};

/// Where a fit takes r from.
enum class FitSamples
{
  rays,    ///< nodes of the standard rule; the outermost hit on the facets
  vertices ///< points of the mesh, for meshes whose points lie on the surface
};

struct FitOptions
{
  FitSamples samples = FitSamples::rays;
  double max_overhang = 0.02; ///< share of directions [-]
};

/// Quality of a fit.
struct ShapeFit
{
  std::vector<double> coefficients; ///< about the mesh's centroid [m]
  Vec3 centroid = Vec3::Zero();     ///< of the mesh, in its own frame [m]
  double mesh_volume = 0.;          ///< [m^3]
  double mesh_area = 0.;            ///< [m^2]
  double residual_rms = 0.;         ///< of r at the samples / mean radius [-]
  double residual_max = 0.;         ///< [-]
  double volume_error = 0.;         ///< of the series / mesh volume - 1 [-]
  /// Width of series and mesh along the direction of the mesh's point that is
  /// farthest from the centroid: their ratio - 1 [-].
  double length_error = 0.;
  double overhang_fraction = 0.; ///< share of directions hit more than once [-]
  double overhang_loss =
      0.; ///< volume lost by taking one hit / mesh volume [-]
  double weld_distance = 0.; ///< points nearer than this are one [m]; 0: equal
  int n_welded = 0;          ///< points that were near, not equal [-]
};

/// Merges points that are equal, or at most `tolerance` [m] apart, and drops
/// triangles that are left with fewer than three.
TriangleMesh weld(const TriangleMesh &mesh, double tolerance = 0.);

/// Least squares for r about the volume centroid. The mesh is welded first,
/// within a millionth of its diagonal if it is open without, and turned
/// outward. Throws std::invalid_argument with one clear line if the mesh is
/// open (number of open edges), empty, has more than one body, does not contain
/// its centroid, or is not star-shaped beyond `max_overhang` (says the share of
/// directions and the volume lost); from vertices also if a triangle faces the
/// centroid or there are not two points for every coefficient.
ShapeFit fit_shape(const TriangleMesh &mesh, int order,
                   const FitOptions &options = {});

/// The series of a surface that is given by its distance from the origin [m] in
/// every direction (unit vectors), which should be the centroid of its volume:
/// least squares on the nodes of the standard rule. The way to add a family of
/// shapes. Throws std::invalid_argument unless the order is 0 to max_order and
/// every radius is positive and finite.
std::vector<double>
fit_radius(const std::function<double(const Vec3 &)> &radius, int order);
} // namespace dem
