#include "test_shapes.h"

#include <gtest/gtest.h>

#include <numeric>

using namespace dem;
using namespace dem::test;

TEST(SphereQuadrature, StandardRuleHas3200NodesOnTheSphere)
{
  const SphereQuadrature &rule = standard_quadrature();
  ASSERT_EQ(rule.direction.size(), 3200u);
  ASSERT_EQ(rule.weight.size(), 3200u);
  for (const Vec3 &s : rule.direction)
    EXPECT_NEAR(s.norm(), 1., 1e-14);
  EXPECT_NEAR(std::accumulate(rule.weight.begin(), rule.weight.end(), 0.),
              4. * std::numbers::pi, 1e-12);
}

// int z^2p = 4 pi / (2 p + 1); degree 78 is the last even one that is exact.
TEST(SphereQuadrature, IntegratesPowersOfEveryAxisToDegree78)
{
  const SphereQuadrature &rule = standard_quadrature();
  for (const int p : {2, 40, 78})
    for (int axis = 0; axis < 3; ++axis)
    {
      double sum = 0.;
      for (std::size_t k = 0; k < rule.weight.size(); ++k)
        sum += rule.weight[k] * std::pow(rule.direction[k][axis], p);
      EXPECT_NEAR(sum, 4. * std::numbers::pi / (p + 1.), 1e-13);
    }
}

TEST(SphereQuadrature, RefusesEmptyRules)
{
  EXPECT_THROW(make_quadrature(0, 8), std::invalid_argument);
  EXPECT_THROW(make_quadrature(4, -1), std::invalid_argument);
}

TEST(NodeRadii, AreTheSeriesAtEveryNode)
{
  for (const int order : {0, 1, 8, 20, 30})
  {
    const std::vector<double> a = random_particle(order, 4);
    const SphereQuadrature rule = make_quadrature(7, 13);
    const std::vector<double> radii = node_radii(a, rule);
    ASSERT_EQ(radii.size(), rule.direction.size());
    for (std::size_t k = 0; k < radii.size(); ++k)
      EXPECT_NEAR(radii[k], radius(a, rule.direction[k]), 1e-14 * a[0]);
  }
}
