#include "test_shapes.h"

#include <dem/shape/measures.h>

#include <gtest/gtest.h>

#include <algorithm>

using namespace dem;
using namespace dem::test;

namespace
{
const Vec3 half_axes(0.012, 0.010, 0.009);

double ellipsoid(const Vec3 &s)
{
  return ellipsoid_radius(half_axes, s);
}

std::string message_of(const TriangleMesh &mesh, int order = 8,
                       const FitOptions &options = {})
{
  try
  {
    fit_shape(mesh, order, options);
  }
  catch (const std::invalid_argument &error)
  {
    return error.what();
  }
  return "";
}

TriangleMesh cube()
{
  TriangleMesh mesh;
  for (int i = 0; i < 8; ++i)
    mesh.points.emplace_back(i & 1, (i >> 1) & 1, (i >> 2) & 1);
  const int quads[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                           {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
  for (const auto &q : quads)
  {
    mesh.triangles.push_back({q[0], q[1], q[2]});
    mesh.triangles.push_back({q[0], q[2], q[3]});
  }
  return mesh;
}

TriangleMesh moved(TriangleMesh mesh, const Vec3 &by)
{
  for (Vec3 &point : mesh.points)
    point += by;
  return mesh;
}

TriangleMesh together(const TriangleMesh &a, const TriangleMesh &b)
{
  TriangleMesh mesh = a;
  const auto shift = int(a.points.size());
  mesh.points.insert(mesh.points.end(), b.points.begin(), b.points.end());
  for (const auto &t : b.triangles)
    mesh.triangles.push_back({t[0] + shift, t[1] + shift, t[2] + shift});
  return mesh;
}

/// A sphere with a groove around its equator.
double spool(const Vec3 &s)
{
  return 1. - 0.5 * std::exp(-std::pow(s.z() / 0.15, 2));
}
} // namespace

TEST(Weld, MergesEqualPointsAndDropsWhatCollapses)
{
  TriangleMesh soup;
  const TriangleMesh whole = cube();
  for (const auto &t : whole.triangles)
  {
    const auto first = int(soup.points.size());
    for (const int point : t)
      soup.points.push_back(whole.points[std::size_t(point)]);
    soup.triangles.push_back({first, first + 1, first + 2});
  }
  soup.points.push_back(whole.points[0]);
  soup.triangles.push_back({0, int(soup.points.size()) - 1, 1});
  const TriangleMesh welded = weld(soup);
  EXPECT_EQ(welded.points.size(), 8u);
  EXPECT_EQ(welded.triangles.size(), 12u);
}

namespace
{
/// A cube whose triangles have corners of their own, off by up to this.
TriangleMesh loose_cube(double off)
{
  const TriangleMesh whole = cube();
  TriangleMesh soup;
  int k = 0;
  for (const auto &t : whole.triangles)
  {
    const auto first = int(soup.points.size());
    for (const int point : t)
      soup.points.push_back(whole.points[std::size_t(point)] +
                            Vec3::Constant(off * double(k++ % 3 - 1)));
    soup.triangles.push_back({first, first + 1, first + 2});
  }
  return soup;
}
} // namespace

// The diagonal of the cube is sqrt(3) of its side: points up to 1.7e-6 of the
// side apart are one.
TEST(Weld, MergesNearPointsOfAMeshThatIsOpenWithoutIt)
{
  const double side = std::cbrt(fit_shape(cube(), 1).mesh_volume);
  const TriangleMesh loose = loose_cube(1e-7 * side);
  EXPECT_GT(weld(loose).points.size(), 8u);
  EXPECT_EQ(weld(loose, 1e-6 * side).points.size(), 8u);
  EXPECT_EQ(weld(loose, 1e-8 * side).points.size(), weld(loose).points.size());
  const ShapeFit fit = fit_shape(loose, 1);
  EXPECT_EQ(std::size_t(fit.n_welded), weld(loose).points.size() - 8u);
  EXPECT_NEAR(fit.weld_distance, 1e-6 * std::sqrt(3.) * side, 1e-8 * side);
  EXPECT_NEAR(fit.mesh_volume, std::pow(side, 3), 1e-6 * std::pow(side, 3));
  EXPECT_EQ(fit_shape(cube(), 1).n_welded, 0);
  EXPECT_THROW(fit_shape(loose_cube(1e-5 * side), 1), std::invalid_argument);
}

// The facets of 120 x 240 are inside by at most (pi / 120)^2 / 8 = 9e-5 of
// the radius of curvature; the ellipsoid of order 20 itself has 1e-7.
TEST(Fit, RecoversAnEllipsoidFromItsMesh)
{
  const Vec3 away(0.3, -0.2, 0.1);
  const ShapeFit fit = fit_shape(moved(radial_mesh(120, ellipsoid), away), 20);
  EXPECT_NEAR((fit.centroid - away).norm(), 0., 1e-9);
  const double volume = 4. / 3. * std::numbers::pi * half_axes.prod();
  EXPECT_NEAR(fit.mesh_volume, volume, 1e-3 * volume);
  EXPECT_LT(fit.mesh_volume, volume);
  for (const Vec3 &s : random_directions(200, 1))
    EXPECT_NEAR(radius(fit.coefficients, s), ellipsoid(s),
                2e-4 * half_axes.x());
  EXPECT_EQ(fit.overhang_fraction, 0.);
  EXPECT_NEAR(fit.overhang_loss, 0., 1e-12);
  EXPECT_LT(fit.residual_max, 1e-3);
}

// Corners on the axes and edges along the meridians of the rule: many rays
// meet edges and corners to round-off and none may be lost.
TEST(Fit, LosesNoRayAtEdgesAndCorners)
{
  const ShapeFit fit =
      fit_shape(radial_mesh(20, [](const Vec3 &) { return 1.; }), 20);
  // inside by at most the sagitta of a facet, (pi / 20)^2 / 4
  for (const Vec3 &s : standard_quadrature().direction)
    EXPECT_NEAR(radius(fit.coefficients, s), 1., 0.01);
  EXPECT_EQ(fit.overhang_fraction, 0.);
  const ShapeFit box = fit_shape(cube(), 20);
  EXPECT_NEAR(box.mesh_volume, 1., 1e-14);
  EXPECT_NEAR(box.mesh_area, 6., 1e-14);
  EXPECT_NEAR((box.centroid - Vec3(0.5, 0.5, 0.5)).norm(), 0., 1e-14);
  // the rays themselves give the volume but for the rule at the edges
  EXPECT_NEAR(measure_shape(box.coefficients, standard_quadrature()).volume, 1.,
              0.003);
  EXPECT_EQ(box.overhang_fraction, 0.);
}

TEST(Fit, TurnsTrianglesOutward)
{
  TriangleMesh mixed = radial_mesh(20, ellipsoid);
  for (std::size_t t = 0; t < mixed.triangles.size(); t += 3)
    std::swap(mixed.triangles[t][0], mixed.triangles[t][1]);
  const ShapeFit straight = fit_shape(radial_mesh(20, ellipsoid), 8);
  const ShapeFit turned = fit_shape(mixed, 8);
  EXPECT_NEAR(turned.mesh_volume, straight.mesh_volume,
              1e-12 * straight.mesh_volume);
  EXPECT_NEAR(turned.coefficients[4], straight.coefficients[4], 1e-12);
}

TEST(Fit, SaysHowManyEdgesAreOpen)
{
  TriangleMesh open = cube();
  open.triangles.pop_back();
  EXPECT_NE(message_of(open).find("open: 3 edges"), std::string::npos)
      << message_of(open);
  EXPECT_NE(message_of({}).find("no triangles"), std::string::npos);
}

TEST(Fit, RefusesWhatIsNoSingleParticle)
{
  const TriangleMesh two = together(cube(), moved(cube(), Vec3(3, 0, 0)));
  EXPECT_NE(message_of(two).find("centroid"), std::string::npos)
      << message_of(two);
  TriangleMesh hollow = cube();
  for (Vec3 &point : hollow.points)
    point = 0.2 * (point - Vec3(0.5, 0.5, 0.5)) + Vec3(0.5, 0.5, 0.5);
  const std::string message = message_of(together(cube(), hollow));
  EXPECT_NE(message.find("2 separate bodies"), std::string::npos) << message;

  TriangleMesh sheet = cube();
  for (Vec3 &point : sheet.points)
    point.z() = 0.;
  EXPECT_NE(message_of(sheet), "");

  TriangleMesh bad = cube();
  bad.points[3].x() = std::nan("");
  EXPECT_NE(message_of(bad).find("point 3 is not finite"), std::string::npos);
}

TEST(Fit, RefusesOrdersOutOfRange)
{
  EXPECT_NE(message_of(cube(), 0).find("must be 1 .. 30"), std::string::npos);
  EXPECT_NE(message_of(cube(), 31).find("must be 1 .. 30"), std::string::npos);
  EXPECT_EQ(message_of(cube(), 30), "");
}

// The series of an order is the start of those above it, and the rule is exact
// for their products: what is left of r can only become less.
TEST(Fit, EveryOrderLeavesLess)
{
  const TriangleMesh mesh = cube();
  const ShapeFit whole = fit_shape(mesh, max_order);
  double before = 1.;
  for (int order = 1; order <= max_order; ++order)
  {
    const ShapeFit fit = fit_shape(mesh, order);
    ASSERT_EQ(fit.coefficients.size(), std::size_t(n_coefficients(order)));
    EXPECT_LE(fit.residual_rms, before * (1. + 1e-9)) << order;
    EXPECT_NEAR(fit.coefficients[1], whole.coefficients[1], 1e-14);
    before = fit.residual_rms;
  }
  EXPECT_LT(before, 0.006);
}

// Bent upward in proportion to the distance from the axis, the lower wall of
// the groove hangs over.
TEST(Fit, SaysWhatAnOverhangCosts)
{
  TriangleMesh mesh = radial_mesh(60, spool);
  EXPECT_EQ(message_of(mesh), "");
  for (Vec3 &point : mesh.points)
    point.z() += 1.5 * (point.x() * point.x() + point.y() * point.y());
  const std::string message = message_of(mesh);
  EXPECT_NE(message.find("not star-shaped"), std::string::npos) << message;
  EXPECT_NE(message.find("% of the directions"), std::string::npos) << message;
  const ShapeFit fit = fit_shape(mesh, 8, {.max_overhang = 1.});
  EXPECT_GT(fit.overhang_fraction, 0.02);
  EXPECT_GT(fit.overhang_loss, 0.);
  EXPECT_LT(fit.overhang_loss, fit.overhang_fraction);
}

// The points lie on the ellipsoid, the facets inside: the fit to the points
// gives back what the facets lose, 3.6e-3 of the volume here. (The meridians of
// 40 rings would be those of the rays.)
TEST(Fit, FromVerticesUndoesTheLossOfFlatFacets)
{
  const TriangleMesh mesh = radial_mesh(36, ellipsoid);
  const double volume = 4. / 3. * std::numbers::pi * half_axes.prod();
  const auto volume_of = [](const ShapeFit &fit)
  { return measure_shape(fit.coefficients, standard_quadrature()).volume; };
  const ShapeFit rays = fit_shape(mesh, 16);
  const ShapeFit points =
      fit_shape(mesh, 16, {.samples = FitSamples::vertices});
  EXPECT_LT(volume_of(rays), (1. - 1e-3) * volume);
  EXPECT_NEAR(volume_of(rays), rays.mesh_volume, 1e-4 * volume);
  // order 16 holds this ellipsoid to 1e-7
  EXPECT_NEAR(volume_of(points), volume, 1e-6 * volume);
  for (const Vec3 &s : random_directions(200, 1))
    EXPECT_NEAR(radius(points.coefficients, s), ellipsoid(s),
                1e-5 * half_axes.x());
  EXPECT_LT(points.residual_max, 1e-5);
}

TEST(Fit, FromVerticesSaysWhatItNeeds)
{
  const FitOptions vertices = {.samples = FitSamples::vertices};
  const std::string few = message_of(cube(), 8, vertices);
  EXPECT_NE(few.find("8 points"), std::string::npos) << few;
  TriangleMesh bent = radial_mesh(60, spool);
  for (Vec3 &point : bent.points)
    point.z() += 1.5 * (point.x() * point.x() + point.y() * point.y());
  const std::string inward = message_of(
      bent, 8, {.samples = FitSamples::vertices, .max_overhang = 1.});
  EXPECT_NE(inward.find("do not face outward"), std::string::npos) << inward;
}
