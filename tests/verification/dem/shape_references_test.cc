#include "../../unit/dem/shape/test_shapes.h"

#include <dem/shape/form.h>
#include <dem/shape/measures.h>
#include <dem/shape/patch.h>

#include <gtest/gtest.h>

// Numbers of an independent program (own harmonics, own quadrature) for two
// exact bodies cut at an order: curvatures at single directions, smallest
// radius, roundness, and the error of the cached expansion.
using namespace dem;
using namespace dem::test;

namespace
{
const Vec3 axes(0.024, 0.020, 0.016);

std::vector<double> ellipsoid(int order)
{
  return project(order,
                 [](const Vec3 &s) { return ellipsoid_radius(axes, s); });
}

std::vector<double> rounded_cube(int order)
{
  return project(order,
                 [](const Vec3 &s)
                 {
                   const Vec3 sixth = s.array().pow(6);
                   return 0.016 / std::pow(sixth.sum(), 1. / 6.);
                 });
}

struct CurvatureAt
{
  Vec3 direction;
  double maximum, minimum; ///< [1/m]
};

const CurvatureAt on_ellipsoid[] = {
    {Vec3(0.9503413856287094, 0.30878463433603953, 0.03877241750605096),
     90.65931035858704, 55.020094628832396},
    {Vec3(-0.22489579270846852, -0.9367583936628834, 0.2681521850072537),
     71.68946612601187, 34.24383820447709},
    {Vec3(0.14241438089907915, -0.8991690131130705, 0.4137792043716051),
     64.39958807568071, 32.75040657447821}};
const CurvatureAt on_cube[] = {
    {Vec3(0.7806973375603373, 0.12365031087234962, -0.6125538896679802),
     135.9255049550636, -2.4757314520202893},
    {Vec3(-0.24425594071916798, -0.7517424876086374, 0.6125538896679802),
     158.98576228009756, 5.751917492685264},
    {Vec3(0.44571641590031896, 0.5218668721661245, 0.7273182551899272),
     97.13315625384558, 44.63924876325371}};

void expect_curvatures(const std::vector<double> &a,
                       std::span<const CurvatureAt> expected)
{
  for (const CurvatureAt &at : expected)
  {
    const PrincipalCurvatures found =
        principal_curvatures(expand(a, at.direction.normalized()));
    // the projections of the cube differ by the aliases of higher degrees
    EXPECT_NEAR(found.maximum, at.maximum, 1e-6 * at.maximum);
    EXPECT_NEAR(found.minimum, at.minimum, 1e-6 * at.maximum);
  }
}

/// Smallest radius over the nodes, roundness with area weights, radius of the
/// inscribed sphere with free centre.
struct MetricsOf
{
  int order;
  double smallest, roundness, inscribed;
};

void expect_metrics(const std::vector<double> &a, const MetricsOf &expected)
{
  const ShapeMeasures of = measure_shape(a, standard_quadrature());
  // 40 x 80 nodes in both, but not the same ones: to the fineness of the nodes
  EXPECT_NEAR(of.inscribed_radius, expected.smallest, 1e-3 * expected.smallest);
  EXPECT_NEAR(of.roundness, expected.roundness, 1e-3);
  EXPECT_NEAR(inscribed_sphere(a).radius, expected.inscribed,
              2e-3 * expected.inscribed);
}

/// Relative change of kappa_max over the angle, against 1 / r_b at least.
double curvature_change(const std::vector<double> &a, double angle)
{
  const int n = 3000;
  const std::vector<Vec3> start = random_directions(n, 1);
  const std::vector<Vec3> toward = random_directions(n, 2);
  double square = 0.;
  for (std::size_t i = 0; i < start.size(); ++i)
  {
    const Vec3 &s = start[i];
    const Vec3 t = (toward[i] - toward[i].dot(s) * s).normalized();
    const auto kappa = [&](const Vec3 &at)
    { return principal_curvatures(expand(a, at)).maximum; };
    const double there = kappa(std::cos(angle) * s + std::sin(angle) * t);
    const double floor = 1. / (a[0] * equivalent_radius_factor);
    square += std::pow((kappa(s) - there) / std::max(there, floor), 2) / n;
  }
  return std::sqrt(square);
}
} // namespace

TEST(ShapeReferences, Curvatures)
{
  expect_curvatures(ellipsoid(20), on_ellipsoid);
  expect_curvatures(rounded_cube(20), on_cube);
}

TEST(ShapeReferences, RoundnessAndInscribedSphere)
{
  expect_metrics(ellipsoid(8), {8, 0.016007535779059126, 0.8275973888622344,
                                0.016007536067872686});
  expect_metrics(ellipsoid(12), {12, 0.016004648147157848, 0.828402973730551,
                                 0.016004648474606874});
  expect_metrics(ellipsoid(20), {20, 0.016004549954897973, 0.8284187339013255,
                                 0.016004550280997083});
  expect_metrics(rounded_cube(8), {8, 0.016334905439899655, 0.5011202417072772,
                                   0.016334905439899655});
  expect_metrics(rounded_cube(12), {12, 0.015898756477460176,
                                    0.47276108478782697, 0.015898756477460176});
  expect_metrics(rounded_cube(20), {20, 0.01599766845520159,
                                    0.44588503161492743, 0.01599766845520159});
}

// Classical formulas for the curvatures of the exact ellipsoid: the 40 x 80
// nodes see the rim of the corners to 0.2 %.
TEST(ShapeReferences, RoundnessOfTheExactEllipsoid)
{
  EXPECT_NEAR(roundness(ellipsoid(20), standard_quadrature()),
              0.8272485754966985, 2e-3);
}

// Random samples of 300 directions there: 10 %.
TEST(ShapeReferences, ChangeOfTheCurvatureWithTheDirection)
{
  EXPECT_NEAR(curvature_change(ellipsoid(20), 5e-3), 2.60e-3, 2.6e-4);
  EXPECT_NEAR(curvature_change(ellipsoid(20), 1e-2), 5.07e-3, 5.1e-4);
  EXPECT_NEAR(curvature_change(rounded_cube(20), 5e-3), 2.13e-2, 2.1e-3);
  EXPECT_NEAR(curvature_change(rounded_cube(20), 1e-2), 4.19e-2, 4.2e-3);
}
