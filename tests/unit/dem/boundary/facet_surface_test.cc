#include <dem/boundary/facet_surface.h>

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <numeric>
#include <random>

using dem::FacetSurface;
using dem::FacetTopology;
using dem::Feature;
using dem::NearestFacetPoint;
using dem::Vec3;

namespace
{
/// A turn and a shift without symmetry, so that no coordinate is round.
const dem::Mat3 turn = (Eigen::AngleAxisd(0.7, Vec3::UnitX()) *
                        Eigen::AngleAxisd(-1.1, Vec3::UnitZ()))
                           .toRotationMatrix();
const Vec3 shift(0.13, -0.07, 0.31);

Vec3 moved(const Vec3 &x)
{
  return turn * x + shift;
}

FacetSurface moved(FacetSurface surface)
{
  for (Vec3 &x : surface.position)
    x = moved(x);
  return surface;
}

/// n triangles round the origin in the plane z = 0.
FacetSurface fan(int n)
{
  FacetSurface surface;
  surface.position.push_back(Vec3::Zero());
  for (int k = 0; k < n; ++k)
  {
    const double angle = 2. * std::numbers::pi * k / n;
    surface.position.push_back(Vec3(std::cos(angle), std::sin(angle), 0.));
    surface.triangles.push_back({0, k + 1, (k + 1) % n + 1});
  }
  return surface;
}

/// The square -1 ... 1, n x n cells in two triangles each, the diagonals one
/// way, the other way or in turns.
FacetSurface grid(int n, int diagonals)
{
  FacetSurface surface;
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i)
      surface.position.push_back(Vec3(2. * i / n - 1., 2. * j / n - 1., 0.));
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i)
    {
      const int a = j * (n + 1) + i, b = a + 1, d = a + n + 1, c = d + 1;
      if (diagonals == 0 || (diagonals == 2 && (i + j) % 2 == 0))
        surface.triangles.insert(surface.triangles.end(),
                                 {{a, b, c}, {a, c, d}});
      else
        surface.triangles.insert(surface.triangles.end(),
                                 {{a, b, d}, {b, c, d}});
    }
  return surface;
}

/// Two unit squares that share the edge x = 0; the second one is turned up by
/// `fold` about it (0: a plane; positive: a valley seen from above).
FacetSurface folded(double fold)
{
  FacetSurface surface;
  const double c = std::cos(fold), s = std::sin(fold);
  surface.position = {Vec3(0., -1., 0.),  Vec3(0., 1., 0.), Vec3(-1., 1., 0.),
                      Vec3(-1., -1., 0.), Vec3(c, -1., s),  Vec3(c, 1., s)};
  surface.triangles = {{0, 1, 2}, {0, 2, 3}, {0, 4, 5}, {0, 5, 1}};
  return surface;
}

std::vector<NearestFacetPoint>
find_nearest_points(const FacetSurface &surface, const FacetTopology &topology,
                    const std::vector<std::int32_t> &triangles, const Vec3 &x,
                    double reach)
{
  std::vector<NearestFacetPoint> touches;
  for (const std::int32_t triangle : triangles)
    touches.push_back(dem::nearest_on_facet(surface, triangle, x));
  std::erase_if(touches, [reach](const NearestFacetPoint &touch)
                { return !(touch.distance < reach); });
  dem::keep_minima(surface, topology, x, touches);
  return touches;
}

std::vector<NearestFacetPoint> touches_of(const FacetSurface &surface,
                                          const Vec3 &x, double reach)
{
  std::vector<std::int32_t> all(surface.triangles.size());
  std::iota(all.begin(), all.end(), 0);
  return find_nearest_points(surface, FacetTopology(surface), all, x, reach);
}

/// One touch straight below a centre at this height. Round-off is 1e-16 of
/// coordinates of size one; a point within 1e-11 of an edge, as an angle from
/// the centre, may be given as the point of the edge.
void expect_one_below(const FacetSurface &plane, const Vec3 &x)
{
  const std::vector<NearestFacetPoint> touches =
      touches_of(moved(plane), moved(x), 1.);
  ASSERT_EQ(touches.size(), 1U) << x.transpose();
  EXPECT_NEAR(touches[0].distance, x.z(), 1e-14);
  EXPECT_LE((touches[0].direction + turn.col(2)).norm(), 2e-11);
  EXPECT_LE((touches[0].nearest.point - moved(Vec3(x.x(), x.y(), 0.))).norm(),
            2e-11);
}
} // namespace

TEST(NearestFacetPoints, FanIsAPlane)
{
  for (const int n : {3, 4, 5, 6, 7, 12})
  {
    SCOPED_TRACE(n);
    expect_one_below(fan(n), Vec3(0., 0., 0.4)); // above the vertex
    for (int k = 0; k < n; ++k)
    {
      const double edge = 2. * std::numbers::pi * k / n;
      const double face = edge + std::numbers::pi / n;
      for (const double r : {1e-16, 1e-15, 1e-14, 1e-13, 1e-12, 1e-11, 1e-10,
                             1e-9, 1e-8, 1e-6, 1e-4, 0.1, 0.3})
      {
        expect_one_below(fan(n),
                         Vec3(r * std::cos(edge), r * std::sin(edge), 0.3));
        expect_one_below(fan(n),
                         Vec3(r * std::cos(face), r * std::sin(face), 0.3));
      }
    }
  }
}

// Two triangles: a square with its diagonal.
TEST(NearestFacetPoints, SquareOfTwoIsAPlane)
{
  for (const int diagonals : {0, 1})
    for (const double t : {-0.5, 0., 0.25})
    {
      expect_one_below(grid(1, diagonals), Vec3(t, t, 0.2));
      expect_one_below(grid(1, diagonals), Vec3(t, -t, 0.2));
    }
}

// From face to edge to vertex to face: distance and direction never change.
TEST(NearestFacetPoints, RollingOverSixTriangles)
{
  for (int k = -200; k <= 200; ++k)
  {
    const double s = 0.003 * k;
    expect_one_below(fan(6), Vec3(s, 0., 0.5)); // along an edge
    expect_one_below(fan(6), Vec3(0.5 * s, s * std::sqrt(0.75), 0.5));
    expect_one_below(fan(6), Vec3(0.8 * s, 0.6 * s, 0.5)); // through faces
    expect_one_below(fan(6), Vec3(s, 0.2, 0.5));           // across edges
  }
}

TEST(NearestFacetPoints, AnotherTriangulationIsTheSamePlane)
{
  std::mt19937 generator(3);
  std::uniform_real_distribution<double> uniform(-0.9, 0.9);
  for (int k = 0; k < 300; ++k)
  {
    double u = uniform(generator), v = uniform(generator);
    if (k % 3 == 0) // on lines and points of the grid
      u = 0.25 * std::round(4. * u);
    if (k % 5 == 0)
      v = 0.25 * std::round(4. * v);
    for (const int diagonals : {0, 1, 2})
      expect_one_below(grid(8, diagonals), Vec3(u, v, 0.3));
  }
}

TEST(NearestFacetPoints, RidgeAndRimAreFound)
{
  // A ridge of 2 x 30 degrees, seen from straight above it.
  const FacetSurface ridge = moved(folded(-std::numbers::pi / 3.));
  const Vec3 up(std::sin(std::numbers::pi / 6.), 0.,
                std::cos(std::numbers::pi / 6.));
  const std::vector<NearestFacetPoint> touches =
      touches_of(ridge, moved(Vec3(0., 0.2, 0.) + 0.3 * up), 1.);
  ASSERT_EQ(touches.size(), 1U);
  EXPECT_EQ(touches[0].nearest.feature, Feature::edge);
  EXPECT_NEAR(touches[0].distance, 0.3, 1e-14);
  EXPECT_LE((touches[0].direction + turn * up).norm(), 1e-13);

  // Beside a rim, and beside a corner of the rim.
  const std::vector<NearestFacetPoint> rim =
      touches_of(moved(grid(2, 2)), moved(Vec3(1.3, 0.4, 0.4)), 1.);
  ASSERT_EQ(rim.size(), 1U);
  EXPECT_EQ(rim[0].nearest.feature, Feature::edge);
  EXPECT_NEAR(rim[0].distance, 0.5, 1e-14);
  const std::vector<NearestFacetPoint> corner =
      touches_of(moved(grid(2, 0)), moved(Vec3(1.2, 1.2, 0.1)), 1.);
  ASSERT_EQ(corner.size(), 1U);
  EXPECT_EQ(corner[0].nearest.feature, Feature::vertex);
  EXPECT_NEAR(corner[0].distance, 0.3, 1e-14);
}

// The tip of a pyramid of n sides, from all directions of its normal cone.
TEST(NearestFacetPoints, TipIsFound)
{
  for (const int n : {3, 4, 6, 9})
  {
    FacetSurface tip = fan(n);
    for (std::size_t k = 1; k < tip.position.size(); ++k)
      tip.position[k].z() = -1.;
    for (const Vec3 &arm :
         {Vec3(0., 0., 0.3), Vec3(0.05, 0.02, 0.3), Vec3(-0.1, 0.05, 0.25)})
    {
      const std::vector<NearestFacetPoint> touches =
          touches_of(moved(tip), moved(arm), 1.);
      ASSERT_EQ(touches.size(), 1U);
      EXPECT_EQ(touches[0].nearest.feature, Feature::vertex);
      EXPECT_NEAR(touches[0].distance, arm.norm(), 1e-14);
    }
  }
}

TEST(NearestFacetPoints, ValleyGivesTwoOrOne)
{
  // 90 degrees: one touch per wall, the nearer first.
  const std::vector<NearestFacetPoint> two = touches_of(
      moved(folded(0.5 * std::numbers::pi)), moved(Vec3(-0.3, 0.1, 0.2)), 1.);
  ASSERT_EQ(two.size(), 2U);
  EXPECT_NEAR(two[0].distance, 0.2, 1e-14);
  EXPECT_NEAR(two[1].distance, 0.3, 1e-14);
  EXPECT_LE((two[0].direction + turn.col(2)).norm(), 1e-13);
  EXPECT_LE((two[1].direction - turn.col(0)).norm(), 1e-13);
  // 30 degrees: one smooth patch, its nearest point.
  const std::vector<NearestFacetPoint> one = touches_of(
      moved(folded(std::numbers::pi / 6.)), moved(Vec3(-0.05, 0.1, 0.3)), 1.);
  ASSERT_EQ(one.size(), 1U);
  EXPECT_LT(one[0].distance, 0.3);
}

TEST(NearestFacetPoints, CornerOfABoxGivesThree)
{
  FacetSurface box;
  for (int k = 0; k < 8; ++k)
    box.position.push_back(
        Vec3(double(k & 1), double(k >> 1 & 1), double(k >> 2 & 1)));
  box.triangles = {{0, 3, 1}, {0, 2, 3}, {4, 5, 7}, {4, 7, 6},
                   {0, 1, 5}, {0, 5, 4}, {2, 7, 3}, {2, 6, 7},
                   {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  const std::vector<NearestFacetPoint> touches =
      touches_of(moved(box), moved(Vec3(0.2, 0.3, 0.1)), 0.45);
  ASSERT_EQ(touches.size(), 3U);
  EXPECT_NEAR(touches[0].distance, 0.1, 1e-14);
  EXPECT_NEAR(touches[1].distance, 0.2, 1e-14);
  EXPECT_NEAR(touches[2].distance, 0.3, 1e-14);
  // The centre, on all diagonals' planes: six walls, six touches.
  EXPECT_EQ(touches_of(moved(box), moved(Vec3(0.5, 0.5, 0.5)), 0.6).size(), 6U);
  // Closed and outward: the normal of each wall is the direction to it.
  for (const NearestFacetPoint &touch : touches)
  {
    const auto &t =
        box.triangles[static_cast<std::size_t>(touch.nearest.triangle)];
    const auto at = [&](int k)
    { return box.position[static_cast<std::size_t>(t[std::size_t(k)])]; };
    const Vec3 normal = (at(1) - at(0)).cross(at(2) - at(0)).normalized();
    EXPECT_LE((turn * normal - touch.direction).norm(), 1e-13);
  }
}

// The global minimum is never lost, wherever the centre is, on a rough
// surface; every touch is a minimum among its neighbourhood by sampling.
TEST(NearestFacetPoints, NearestIsNeverLost)
{
  std::mt19937 generator(5);
  std::uniform_real_distribution<double> uniform(-1., 1.);
  FacetSurface rough = grid(6, 2);
  for (Vec3 &x : rough.position)
    x.z() = 0.15 * uniform(generator);
  const FacetTopology topology(rough);
  std::vector<std::int32_t> all(rough.triangles.size());
  std::iota(all.begin(), all.end(), 0);
  for (int k = 0; k < 5000; ++k)
  {
    const double u = uniform(generator), v = uniform(generator);
    Vec3 x(1.2 * u, 1.2 * v, 0.5 * uniform(generator));
    if (k % 4 == 0) // straight above a vertex, or on it
      x = rough.position[std::size_t(k) % rough.position.size()] +
          Vec3(0., 0., k % 8 == 0 ? 0. : 0.2);
    double least = 1e300;
    for (const auto &t : rough.triangles)
      least = std::min(
          least, (dem::nearest_point(x, {rough.position[std::size_t(t[0])],
                                         rough.position[std::size_t(t[1])],
                                         rough.position[std::size_t(t[2])]})
                      .point -
                  x)
                     .norm());
    const std::vector<NearestFacetPoint> touches =
        find_nearest_points(rough, topology, all, x, 5.);
    ASSERT_FALSE(touches.empty());
    EXPECT_NEAR(touches[0].distance, least, 1e-15); // round-off
    for (std::size_t i = 0; i < touches.size(); ++i)
    {
      EXPECT_NEAR(touches[i].direction.norm(), 1., 1e-14);
      for (std::size_t j = 0; j < i; ++j)
        EXPECT_LE(touches[i].direction.dot(touches[j].direction),
                  std::sqrt(0.5) + 1e-14);
    }
  }
}

TEST(NearestFacetPoints, ReachCandidatesAndOrderAreKept)
{
  const FacetSurface plane = fan(6);
  EXPECT_TRUE(touches_of(plane, Vec3(0.2, 0.1, 0.5), 0.5).empty());
  EXPECT_EQ(touches_of(plane, Vec3(0.2, 0.1, 0.5), 0.5001).size(), 1U);

  const FacetTopology topology(plane);
  EXPECT_TRUE(find_nearest_points(plane, topology, {3}, Vec3(0.2, 0.1, 0.5), 1.)
                  .empty()); // nearer ones share its vertex

  // The order of the candidates does not matter.
  const Vec3 above(0., 0., 0.5);
  const std::vector<NearestFacetPoint> one_way = find_nearest_points(
                                           plane, topology, {0, 1, 2, 3, 4, 5},
                                           above, 1.),
                                       other_way = find_nearest_points(
                                           plane, topology, {5, 3, 4, 1, 2, 0},
                                           above, 1.);
  ASSERT_EQ(one_way.size(), 1U);
  ASSERT_EQ(other_way.size(), 1U);
  EXPECT_EQ(one_way[0].nearest.triangle, other_way[0].nearest.triangle);
}

// A sliver in a coplanar mesh neither hides nor doubles a touch.
TEST(NearestFacetPoints, SliversAreHarmless)
{
  for (const double height : {1e-2, 1e-4, 1e-6, 1e-7, 4e-9})
  {
    FacetSurface plane;
    plane.position = {Vec3(-1., 0., 0.), Vec3(1., 0., 0.), Vec3(0., 1., 0.),
                      Vec3(0., -1., 0.), Vec3(0., -height, 0.)};
    // The edge 0-1 is one side of a sliver, its other two sides carry the
    // lower half.
    plane.triangles = {{0, 1, 2}, {0, 4, 1}, {0, 3, 4}, {4, 3, 1}};
    for (const double x : {-0.5, 0., 1e-12, 0.4})
      for (const double y : {-0.2, -height, 0., 0.3, 0.45, -0.5 * height})
      {
        SCOPED_TRACE(testing::Message() << height << " " << x << " " << y);
        const std::vector<NearestFacetPoint> touches =
            touches_of(moved(plane), moved(Vec3(x, y, 0.3)), 1.);
        ASSERT_EQ(touches.size(), 1U);
        // A sliver thinner than 1e-6 is its sides: off by its height at most.
        EXPECT_NEAR(touches[0].distance, 0.3, 1e-12);
      }
  }
}
