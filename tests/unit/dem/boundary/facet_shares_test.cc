#include <dem/boundary/facet_surface.h>

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <random>
#include <set>
#include <utility>

using dem::FacetShares;
using dem::FacetSurface;
using dem::FacetTopology;
using dem::NearestFacetPoint;
using dem::PressedSphere;
using dem::Vec3;

namespace
{
/// The square -1 ... 1 in 2 n^2 triangles, its vertices up and down by at most
/// `rise`.
FacetSurface rough_square(int n, double rise, unsigned seed)
{
  std::mt19937 generator(seed);
  std::uniform_real_distribution<double> some(-1., 1.);
  FacetSurface surface;
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i)
      surface.position.push_back(
          Vec3(2. * i / n - 1., 2. * j / n - 1., rise * some(generator)));
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i)
    {
      const int a = j * (n + 1) + i, b = a + 1, d = a + n + 1, c = d + 1;
      if ((i + j) % 2 == 0)
        surface.triangles.insert(surface.triangles.end(),
                                 {{a, c, b}, {a, d, c}});
      else
        surface.triangles.insert(surface.triangles.end(),
                                 {{a, d, b}, {b, d, c}});
    }
  return surface;
}

/// Two squares that share the edge x = 0 and rise from it by `slope`.
FacetSurface groove(double slope)
{
  FacetSurface surface;
  for (const double y : {-1., 1.})
    for (const double x : {-1., 0., 1.})
      surface.position.push_back(Vec3(x, y, slope * std::abs(x)));
  surface.triangles = {{0, 3, 1}, {1, 3, 4}, {1, 4, 2}, {2, 4, 5}};
  return surface;
}

struct Touches
{
  std::vector<NearestFacetPoint> touch;
  std::vector<FacetShares> shares;
};

Touches touches_of(const FacetSurface &surface, const PressedSphere &ball)
{
  const FacetTopology topology(surface);
  std::vector<NearestFacetPoint> near;
  for (std::size_t t = 0; t < surface.triangles.size(); ++t)
  {
    near.push_back(
        dem::nearest_on_facet(surface, std::int32_t(t), ball.centre));
    if (near.back().distance >= 1.2 * ball.radius)
      near.pop_back();
  }
  Touches found{near, {}};
  dem::keep_minima(surface, topology, ball.centre, found.touch);
  dem::share_patches({surface, topology}, ball, near, found.touch,
                     found.shares);
  return found;
}

double overlap(const PressedSphere &ball, const Touches &found, std::size_t t)
{
  return ball.radius - found.touch[t].distance + found.shares[t].extra;
}

/// Forces of stiffness one on the vertices, by the shares.
std::vector<Vec3> loads(const FacetSurface &surface, const PressedSphere &ball)
{
  const Touches found = touches_of(surface, ball);
  std::vector<Vec3> load(surface.position.size(), Vec3::Zero());
  for (std::size_t t = 0; t < found.touch.size(); ++t)
  {
    const double depth = overlap(ball, found, t);
    if (depth <= 0.)
      continue;
    const double force = std::pow(depth, ball.power);
    const FacetShares &shares = found.shares[t];
    for (const dem::VertexShare &share : shares.of)
      load[std::size_t(share.vertex)] += force * share.along;
    const dem::NearestPoint &nearest = found.touch[t].nearest;
    for (std::size_t c = 0; shares.of.empty() && c < 3; ++c)
      load[std::size_t(surface.triangles[std::size_t(nearest.triangle)][c])] +=
          force * nearest.weight[c] * found.touch[t].direction;
  }
  return load;
}

Vec3 sum_of(const std::vector<Vec3> &load)
{
  Vec3 sum = Vec3::Zero();
  for (const Vec3 &part : load)
    sum += part;
  return sum;
}

double well(double depth, double power)
{
  return depth > 0. ? std::pow(depth, power + 1.) / (power + 1.) : 0.;
}

/// Energy of all triangles, less that of the edges that two of them share, and
/// of the vertices that lie inside: by sets, without any nearest feature.
double energy(const FacetSurface &surface, const PressedSphere &ball)
{
  const auto point = [&surface](std::int32_t v)
  { return surface.position[std::size_t(v)]; };
  std::map<std::pair<std::int32_t, std::int32_t>, int> edges;
  std::map<std::int32_t, int> count; // triangles less shared edges
  double sum = 0.;
  for (const auto &t : surface.triangles)
  {
    const Vec3 nearest =
        dem::nearest_point(ball.centre, {point(t[0]), point(t[1]), point(t[2])})
            .point;
    sum += well(ball.radius - (nearest - ball.centre).norm(), ball.power);
    for (std::size_t c = 0; c < 3; ++c)
    {
      ++edges[std::minmax(t[c], t[(c + 1) % 3])];
      ++count[t[c]];
    }
  }
  for (const auto &[ends, n] : edges)
  {
    if (n < 2)
      continue;
    const Vec3 a = point(ends.first), side = point(ends.second) - a;
    const double s =
        std::clamp((ball.centre - a).dot(side) / side.squaredNorm(), 0., 1.);
    sum -= well(ball.radius - (a + s * side - ball.centre).norm(), ball.power);
    --count[ends.first];
    --count[ends.second];
  }
  for (const auto &[v, n] : count)
    sum += (1 - n) *
           well(ball.radius - (point(v) - ball.centre).norm(), ball.power);
  return sum;
}
} // namespace

// Forces on ball and vertices are the derivatives of one energy: over faces,
// valleys, ridges, dimples and rims, by central differences.
TEST(FacetShares, ForcesAreTheGradientOfOneEnergy)
{
  std::mt19937 generator(3);
  std::uniform_real_distribution<double> some(-1., 1.);
  int n_shared = 0, n_alone = 0;
  for (int k = 0; k < 600; ++k)
  {
    FacetSurface surface = rough_square(4, 0.08, unsigned(k));
    PressedSphere ball{{0.9 * some(generator), 0.9 * some(generator), 0.},
                       0.5,
                       k % 2 == 0 ? 1. : 1.5};
    ball.centre.z() = ball.radius - 0.04 + 0.06 * some(generator);
    const Touches found = touches_of(surface, ball);
    for (std::size_t t = 0; t < found.touch.size(); ++t)
    {
      n_shared += !found.shares[t].of.empty();
      n_alone += found.shares[t].of.empty();
    }
    const std::vector<Vec3> load = loads(surface, ball);
    const double size = sum_of(load).norm();
    constexpr double h = 1e-6;
    Vec3 slope;
    for (int c = 0; c < 3; ++c)
    {
      PressedSphere up = ball, down = ball;
      up.centre[c] += h;
      down.centre[c] -= h;
      slope[c] = (energy(surface, up) - energy(surface, down)) / (2. * h);
    }
    ASSERT_LT((slope - sum_of(load)).norm(), 1e-6 * size + 1e-9) << k;
    for (std::size_t v = 0; v < load.size(); ++v)
      for (int c = 0; c < 3; ++c)
      {
        const double at = surface.position[v][c];
        surface.position[v][c] = at + h;
        const double above = energy(surface, ball);
        surface.position[v][c] = at - h;
        const double below = energy(surface, ball);
        surface.position[v][c] = at;
        ASSERT_NEAR((below - above) / (2. * h), load[v][c], 1e-6 * size + 1e-9)
            << k << ' ' << v << ' ' << c;
      }
  }
  EXPECT_GT(n_shared, 80);
  EXPECT_GT(n_alone, 10);
}

// A fine bowl about a ball that presses on hundreds of its facets at once:
// still one energy, whatever their number.
TEST(FacetShares, DozensOfFacetsShareOneEnergy)
{
  for (const double power : {1., 1.5})
  {
    FacetSurface bowl = rough_square(40, 1e-4, 5);
    const PressedSphere ball{{0.013, 0.021, 0.5 - 0.008}, 0.5, power};
    for (Vec3 &x : bowl.position)
      x.z() += x.head<2>().squaredNorm() * 0.9;
    const Touches found = touches_of(bowl, ball);
    ASSERT_EQ(found.touch.size(), 1U);
    const std::vector<dem::VertexShare> &of = found.shares[0].of;
    EXPECT_GT(of.size(), 40U);
    const std::vector<Vec3> load = loads(bowl, ball);
    const double size = sum_of(load).norm();
    ASSERT_GT(size, 0.);
    constexpr double h = 1e-6;
    for (std::size_t s = 0; s < of.size(); s += 7)
      for (int c = 0; c < 3; ++c)
      {
        const auto v = static_cast<std::size_t>(of[s].vertex);
        const double at = bowl.position[v][c];
        bowl.position[v][c] = at + h;
        const double above = energy(bowl, ball);
        bowl.position[v][c] = at - h;
        const double below = energy(bowl, ball);
        bowl.position[v][c] = at;
        EXPECT_NEAR((below - above) / (2. * h), load[v][c], 1e-5 * size)
            << v << ' ' << c;
      }
  }
}

// What presses across the normal acts below the centre along it: no moment is
// lost, whatever carries it.
TEST(FacetShares, WeightsMeetBelowTheCentre)
{
  int n_shared = 0;
  for (unsigned k = 0; k < 100; ++k)
  {
    const FacetSurface surface = rough_square(4, 0.08, k);
    const PressedSphere ball{{0.1, -0.2, 0.45}, 0.5, 1.};
    const Touches found = touches_of(surface, ball);
    for (std::size_t t = 0; t < found.touch.size(); ++t)
    {
      const FacetShares &shares = found.shares[t];
      double whole = 0.;
      Vec3 point = Vec3::Zero(), along = Vec3::Zero();
      for (const dem::VertexShare &share : shares.of)
      {
        whole += share.weight;
        along += share.along;
        point += share.weight * surface.position[std::size_t(share.vertex)];
      }
      if (shares.of.empty())
        continue;
      ++n_shared;
      const NearestFacetPoint &touch = found.touch[t];
      EXPECT_NEAR(whole, 1., 1e-13);
      EXPECT_LT((along - touch.direction).norm(), 1e-13);
      EXPECT_LT((point - touch.nearest.point).norm(), 1e-13);
      EXPECT_LT((ball.centre + touch.distance * touch.direction - point).norm(),
                1e-13);
    }
  }
  EXPECT_GT(n_shared, 15);
}

// In the plane one triangle carries all, over edges and vertices too.
TEST(FacetShares, APlaneIsOnePlane)
{
  const FacetSurface plane = rough_square(4, 0., 1);
  std::mt19937 generator(7);
  std::uniform_real_distribution<double> some(-1., 1.);
  for (int k = 0; k < 200; ++k)
  {
    PressedSphere ball{{0.5 * some(generator), 0.5 * some(generator), 0.25},
                       0.3 + 0.3 * std::abs(some(generator)),
                       1.};
    if (k % 4 == 0)
      ball.centre = {0.5 * (k % 3 - 1), 0.5 * (k % 2), 0.25};
    const Touches found = touches_of(plane, ball);
    ASSERT_EQ(found.touch.size(), 1U);
    ASSERT_NEAR(overlap(ball, found, 0), ball.radius - 0.25, 1e-13);
    ASSERT_LT((found.touch[0].direction + Vec3::UnitZ()).norm(), 1e-12);
  }
}

// A valley flatter than 45 degrees: both sides carry, each the overlap it has.
TEST(FacetShares, ValleyIsCarriedByBothSides)
{
  const double half = 0.3, radius = 0.2, sunk = 1e-4;
  const FacetSurface valley = groove(std::tan(half));
  const PressedSphere ball{
      {0., 0.1, (radius - sunk) / std::cos(half)}, radius, 1.};
  const Touches found = touches_of(valley, ball);
  ASSERT_EQ(found.touch.size(), 1U);
  EXPECT_NEAR(overlap(ball, found, 0), 2. * sunk * std::cos(half), 1e-9 * sunk);
  EXPECT_EQ(found.shares[0].walls, 2);
  EXPECT_LT((found.touch[0].direction + Vec3::UnitZ()).norm(), 1e-10);
}

// From one wall to the other force and load change little by little.
TEST(FacetShares, NothingJumpsAcrossAValley)
{
  for (const double slope : {1e-4, 1e-2, 0.1, 0.3})
  {
    const FacetSurface valley = groove(slope);
    constexpr double step = 1e-5, radius = 0.2, sunk = 1e-3;
    std::vector<Vec3> before;
    for (double x = -0.15; x < 0.15; x += step)
    {
      const PressedSphere ball{
          {x, 0.1,
           (radius - sunk) * std::sqrt(1. + slope * slope) +
               slope * std::abs(x)},
          radius,
          1.};
      const std::vector<Vec3> now = loads(valley, ball);
      for (std::size_t v = 0; v < before.size(); ++v)
        ASSERT_LT((now[v] - before[v]).norm(), 3. * step) << slope << ' ' << x;
      before = now;
    }
  }
}
