#include <dem/boundary/facet_surface.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

using dem::Feature;
using dem::NearestPoint;
using dem::Vec3;

namespace
{
using Corners = std::array<Vec3, 3>;

const Corners plain{Vec3(0., 0., 0.), Vec3(1., 0., 0.), Vec3(0., 1., 0.)};

/// Least distance to a grid of n (n + 1) / 2 points of the triangle [m].
double sampled_distance(const Vec3 &x, const Corners &corner, int n)
{
  double best = 1e300;
  for (int i = 0; i <= n; ++i)
    for (int j = 0; i + j <= n; ++j)
    {
      const Vec3 point = corner[0] + double(i) / n * (corner[1] - corner[0]) +
                         double(j) / n * (corner[2] - corner[0]);
      best = std::min(best, (x - point).norm());
    }
  return best;
}

void expect_consistent(const NearestPoint &nearest, const Corners &corner,
                       double size)
{
  Vec3 point = Vec3::Zero();
  double sum = 0.;
  for (std::size_t k = 0; k < 3; ++k)
  {
    point += nearest.weight[k] * corner[k];
    sum += nearest.weight[k];
    EXPECT_GE(nearest.weight[k], -1e-15);
  }
  // Round-off only.
  EXPECT_NEAR(sum, 1., 1e-14);
  EXPECT_LE((point - nearest.point).norm(), 1e-14 * size);
}
} // namespace

TEST(NearestPoint, SevenRegions)
{
  struct
  {
    Vec3 x, point;
    Feature feature;
    int which;
  } const cases[] = {{{0.25, 0.5, 3.}, {0.25, 0.5, 0.}, Feature::face, 0},
                     {{-1., -2., 1.}, {0., 0., 0.}, Feature::vertex, 0},
                     {{3., -0.5, 1.}, {1., 0., 0.}, Feature::vertex, 1},
                     {{-0.5, 3., -1.}, {0., 1., 0.}, Feature::vertex, 2},
                     {{0.4, -2., 1.}, {0.4, 0., 0.}, Feature::edge, 0},
                     {{1.25, 0.75, 1.}, {0.75, 0.25, 0.}, Feature::edge, 1},
                     {{-2., 0.3, -1.}, {0., 0.3, 0.}, Feature::edge, 2}};
  for (const auto &c : cases)
  {
    const NearestPoint nearest = dem::nearest_point(c.x, plain);
    EXPECT_LE((nearest.point - c.point).norm(), 1e-15); // round-off
    EXPECT_EQ(nearest.feature, c.feature);
    EXPECT_EQ(nearest.which, c.which);
    expect_consistent(nearest, plain, 1.);
  }
}

TEST(NearestPoint, BarycentricWeights)
{
  const NearestPoint nearest = dem::nearest_point(Vec3(0.2, 0.3, -5.), plain);
  EXPECT_NEAR(nearest.weight[0], 0.5, 1e-15);
  EXPECT_NEAR(nearest.weight[1], 0.2, 1e-15);
  EXPECT_NEAR(nearest.weight[2], 0.3, 1e-15);
}

// A grid of spacing h = size / 60 misses the nearest point by at most h, so
// the sampled distance is larger by 0 to h.
TEST(NearestPoint, NeverFartherThanASample)
{
  std::mt19937 generator(7);
  std::uniform_real_distribution<double> uniform(-1., 1.);
  const auto random_point = [&]
  {
    const double x = uniform(generator), y = uniform(generator);
    return Vec3(x, y, uniform(generator));
  };
  for (int k = 0; k < 500; ++k)
  {
    const Corners corner{random_point(), random_point(), random_point()};
    const Vec3 x = 2. * random_point();
    const NearestPoint nearest = dem::nearest_point(x, corner);
    const double distance = (x - nearest.point).norm();
    const double sampled = sampled_distance(x, corner, 60);
    const double size = std::max({(corner[1] - corner[0]).norm(),
                                  (corner[2] - corner[0]).norm(),
                                  (corner[2] - corner[1]).norm()});
    EXPECT_LE(distance, sampled + 1e-12);
    EXPECT_GE(distance, sampled - size / 60.);
    expect_consistent(nearest, corner, 4.);
  }
}

TEST(NearestPoint, OrderOfTheCornersDoesNotMatter)
{
  std::mt19937 generator(8);
  std::uniform_real_distribution<double> uniform(-1., 1.);
  const Corners corner{Vec3(0.1, 0.2, -0.3), Vec3(0.9, 0.1, 0.2),
                       Vec3(0.3, 0.8, 0.1)};
  for (int k = 0; k < 500; ++k)
  {
    const double u = uniform(generator), v = uniform(generator);
    const Vec3 x(2. * u, 2. * v, uniform(generator));
    const Vec3 first = dem::nearest_point(x, corner).point;
    const Vec3 turned =
        dem::nearest_point(x, {corner[1], corner[2], corner[0]}).point;
    const Vec3 mirrored =
        dem::nearest_point(x, {corner[0], corner[2], corner[1]}).point;
    // Round-off of coordinates of size one, with weights amplified by the
    // ratio of side to height (3) and distance to height (5).
    EXPECT_LE((first - turned).norm(), 1e-14);
    EXPECT_LE((first - mirrored).norm(), 1e-14);
  }
}

// Triangles without area: three points on a line, two equal points, one
// point; and slivers with heights down to round-off.
TEST(NearestPoint, SliversHaveAnAnswer)
{
  const Vec3 a(0.3, 0.1, -0.2), side(0.7, 0.4, 0.2);
  const Vec3 up = Vec3(0.1, -0.3, 0.25);
  std::mt19937 generator(9);
  std::uniform_real_distribution<double> uniform(-2., 2.);
  for (const double height : {0., 1e-18, 1e-15, 1e-12, 1e-9, 1e-7, 1e-5})
    for (const double third : {0., 0.5, 1., 1.7, -0.4})
      for (int k = 0; k < 100; ++k)
      {
        const Corners corner{a, a + side, a + third * side + height * up};
        const double u = uniform(generator), v = uniform(generator);
        const Vec3 x(u, v, uniform(generator));
        const NearestPoint nearest = dem::nearest_point(x, corner);
        ASSERT_TRUE(nearest.point.allFinite());
        // Along the line the answer is known; the height moves it by less
        // than itself, and 1e-6 is the height below which sides are used.
        const double low = std::min({0., third}), high = std::max({1., third});
        const double t =
            std::clamp((x - a).dot(side) / side.squaredNorm(), low, high);
        const double distance = (x - a - t * side).norm();
        EXPECT_NEAR((x - nearest.point).norm(), distance, 1e-6 + height);
        expect_consistent(nearest, corner, 4.);
      }
  const NearestPoint point = dem::nearest_point(up, {a, a, a});
  EXPECT_EQ(point.point, a);
}
