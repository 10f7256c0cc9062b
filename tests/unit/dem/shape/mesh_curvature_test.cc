#include "test_shapes.h"

#include <dem/shape/mesh_curvature.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>

using namespace dem;
using namespace dem::test;

namespace
{
/// Largest principal curvature of the surface F = 1 with this gradient and
/// these second derivatives (all mixed ones zero).
double implicit_curvature(const Vec3 &gradient, const Vec3 &second)
{
  const Vec3 normal = gradient.normalized();
  const Mat3 tangent = Mat3::Identity() - normal * normal.transpose();
  const Mat3 shape = tangent * second.asDiagonal() * tangent / gradient.norm();
  return Eigen::SelfAdjointEigenSolver<Mat3>(shape, Eigen::EigenvaluesOnly)
      .eigenvalues()[2];
}

double ellipsoid_curvature(const Vec3 &axes, const Vec3 &point)
{
  const Vec3 squares = axes.cwiseProduct(axes);
  return implicit_curvature(2. * point.cwiseQuotient(squares),
                            2. * squares.cwiseInverse());
}

constexpr double half_edge = 0.02;

/// The rounded cube of scripts/rounded_cube.py: x^6 + y^6 + z^6 = a^6.
double cube_radius(const Vec3 &s)
{
  return half_edge / std::pow(s.array().pow(6).sum(), 1. / 6.);
}

double cube_curvature(const Vec3 &point)
{
  const Vec3 x = point / half_edge;
  return implicit_curvature(6. * x.array().pow(5).matrix(),
                            30. * x.array().pow(4).matrix()) /
         half_edge;
}
} // namespace

// Two rings of edges of 2 degrees are patches of the angular radius 0.07.
// Fourth derivatives add half its square: 2.4e-3, a quarter of it at twice the
// rings.
TEST(MeshCurvature, IsThatOfASphere)
{
  const double radius = 0.01;
  const TriangleMesh mesh =
      radial_mesh(90, [&](const Vec3 &) { return radius; });
  for (const PointCurvature &one : mesh_curvatures(mesh, 0.05 * radius))
  {
    EXPECT_NEAR(one.maximum * radius, 1., 3e-3);
    EXPECT_NEAR(one.minimum * radius, 1., 3e-3);
  }
  const std::vector<double> areas = point_areas(mesh);
  double area = 0.;
  for (const double one : areas)
    area += one;
  // Of the facets: 2 degrees of a sphere.
  EXPECT_NEAR(area, 4. * std::numbers::pi * radius * radius, 1e-3 * area);
}

TEST(MeshCurvature, IsThatOfAnEllipsoid)
{
  const Vec3 axes(0.012, 0.010, 0.008);
  const TriangleMesh mesh =
      radial_mesh(90, [&](const Vec3 &s) { return ellipsoid_radius(axes, s); });
  const auto found = mesh_curvatures(mesh, 0.05 * 0.01);
  for (std::size_t k = 0; k < found.size(); ++k)
  {
    const double exact = ellipsoid_curvature(axes, mesh.points[k]);
    EXPECT_NEAR(found[k].maximum, exact, 7e-3 * exact);
  }
}

// In the middle of an edge the curvature is (p - 1) 2^(1/p) / sqrt(2) / a with
// p = 6. Corners are found from the mesh as from the exact surface; where they
// differ kappa_max r_ins is 1 within the error of the patch.
TEST(MeshCurvature, FindsTheEdgesOfARoundedCube)
{
  const TriangleMesh mesh = radial_mesh(90, cube_radius);
  const auto found = mesh_curvatures(mesh, 0.05 * half_edge);
  const std::vector<double> areas = point_areas(mesh);
  const double of_edge =
      5. * std::pow(2., 1. / 6.) / std::numbers::sqrt2 / half_edge;
  const Vec3 edge = Vec3(1., 1., 0.).normalized();
  EXPECT_NEAR(cube_curvature(cube_radius(edge) * edge), of_edge,
              1e-9 * of_edge);
  double area = 0., same = 0., nearest = 1., at_edge = 0.;
  for (std::size_t k = 0; k < found.size(); ++k)
  {
    const double exact = cube_curvature(mesh.points[k]);
    area += areas[k];
    if ((exact * half_edge > 1.) == (found[k].maximum * half_edge > 1.))
      same += areas[k];
    const double distance = (mesh.points[k].normalized() - edge).norm();
    if (distance < nearest)
    {
      nearest = distance;
      at_edge = found[k].maximum;
    }
  }
  EXPECT_GT(same, 0.99 * area);
  EXPECT_NEAR(at_edge, of_edge, 0.04 * of_edge);
}

// The mesh is that of the series: both agree but for a band along
// kappa_max r_ins = 1, which the error of the patches shifts.
TEST(CornerComparison, AgreesForASeriesAndItsMesh)
{
  const auto series = random_particle(12, 7);
  const TriangleMesh mesh =
      radial_mesh(90, [&](const Vec3 &s) { return radius(series, s); });
  const ShapeFit fit = fit_shape(mesh, 12);
  const CornerComparison all = compare_corners(mesh, fit.coefficients, 0.05);
  EXPECT_EQ(all.points.size(), mesh.points.size());
  EXPECT_GT(all.agreement, 0.95);
  EXPECT_NEAR(all.corners_mesh, all.corners_series, 0.02);
  EXPECT_NEAR(
      all.agreement,
      1. - (all.corners_mesh + all.corners_series - 2. * all.corners_both),
      1e-12);
  EXPECT_LT(all.residual_rms, 1e-3);
  EXPECT_NEAR(all.inscribed_mesh, all.inscribed_series,
              1e-2 * all.inscribed_series);
}

TEST(CornerComparison, RefusesAnOpenMesh)
{
  TriangleMesh mesh = radial_mesh(10, [](const Vec3 &) { return 0.01; });
  mesh.triangles.pop_back();
  EXPECT_THROW(compare_corners(mesh, sphere_series(4, 0.01), 0.05),
               std::invalid_argument);
}
