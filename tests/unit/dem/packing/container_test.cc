#include <dem/boundary/wall_mesh.h>
#include <dem/packing/container.h>

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>

// Containers of triangles: what they hold, and which are none.
namespace
{
using dem::Vec3;

/// A ring of corners at a height.
struct Ring
{
  double z = 0., radius = 0.;
};

/// Rings of n corners with flat quads between, and a floor.
dem::TriangleMesh cup(const std::vector<Ring> &rings, int n,
                      const Vec3 &origin = Vec3(0.3, -0.2, 7.))
{
  dem::TriangleMesh mesh;
  for (const Ring &ring : rings)
    for (int k = 0; k < n; ++k)
    {
      const double angle = 2. * std::numbers::pi * k / n;
      mesh.points.push_back(origin + Vec3(ring.radius * std::cos(angle),
                                          ring.radius * std::sin(angle),
                                          ring.z));
    }
  for (std::int32_t k = 2; k < n; ++k)
    mesh.triangles.push_back({0, k, k - 1});
  for (std::int32_t ring = 0; ring + 1 < std::int32_t(rings.size()); ++ring)
    for (std::int32_t k = 0; k < n; ++k)
    {
      const std::int32_t a = ring * n + k, b = ring * n + (k + 1) % n;
      mesh.triangles.push_back({a, b, b + n});
      mesh.triangles.push_back({a, b + n, a + n});
    }
  return mesh;
}

/// The last ring gets a lid.
dem::TriangleMesh with_lid(dem::TriangleMesh mesh, int n)
{
  const auto first = static_cast<std::int32_t>(mesh.points.size()) - n;
  for (std::int32_t k = 2; k < n; ++k)
    mesh.triangles.push_back({first, first + k - 1, first + k});
  return mesh;
}

/// Without its floor.
dem::TriangleMesh tube(dem::TriangleMesh cup, int n)
{
  cup.triangles.erase(cup.triangles.begin(), cup.triangles.begin() + n - 2);
  return cup;
}

constexpr auto no_floor = dem::ContainerBottom::open;

dem::Container
container(const dem::TriangleMesh &mesh,
          dem::ContainerBottom bottom = dem::ContainerBottom::closed)
{
  return dem::Container(dem::wall_surface(mesh, dem::WallSide::inside), bottom);
}

double area_of_ring(double radius, int n)
{
  return 0.5 * n * radius * radius * std::sin(2. * std::numbers::pi / n);
}

std::string refusal(const dem::TriangleMesh &mesh,
                    dem::ContainerBottom bottom = dem::ContainerBottom::closed)
{
  try
  {
    container(mesh, bottom);
  }
  catch (const std::invalid_argument &error)
  {
    return error.what();
  }
  return {};
}

constexpr double exact = 1e-12; ///< round-off of sums [-]

TEST(Container, BoxHoldsItsVolume)
{
  const double side = 0.2, height = 0.3;
  const dem::TriangleMesh open =
      cup({{0., side / std::sqrt(2.)}, {height, side / std::sqrt(2.)}}, 4);
  for (const dem::TriangleMesh &mesh : {open, with_lid(open, 4)})
  {
    const dem::Container box = container(mesh);
    EXPECT_NEAR(box.rim(), height, exact);
    for (const double z : {0.001, 0.1, 0.29, height, 0.4})
    {
      EXPECT_NEAR(box.volume_below(z), side * side * z,
                  exact * side * side * height);
      EXPECT_NEAR(box.section(z), side * side, exact * side * side);
      EXPECT_NEAR(box.height_of(side * side * z), z, exact);
    }
    EXPECT_EQ(box.volume_below(-0.1), 0.);
  }
}

// The polygon of so many corners is the circle to (2 pi / n)^2 / 6 = 7e-10.
TEST(Container, CylinderHoldsItsVolume)
{
  constexpr int n = 100000;
  const double radius = 0.075, height = 0.15;
  const dem::Container cylinder =
      container(cup({{0., radius}, {height, radius}}, n));
  const double area = std::numbers::pi * radius * radius;
  for (const double z : {0.05, 0.1, height})
  {
    EXPECT_NEAR(cylinder.volume_below(z), area * z, 1e-9 * area * z);
    EXPECT_NEAR(cylinder.section(z), area, 1e-9 * area);
  }
}

// Sections of a frustum grow with the square of the height; between rings of
// different corners triangles are cut in both of their halves.
TEST(Container, FrustumHoldsItsVolume)
{
  constexpr int n = 12;
  const double low = 0.05, high = 0.09, height = 0.2;
  const dem::Container frustum = container(cup({{0., low}, {height, high}}, n));
  for (const double z : {0.01, 0.07, 0.2})
  {
    const double at = low + (high - low) * z / height;
    const double volume =
        z / 3. *
        (area_of_ring(low, n) + area_of_ring(at, n) +
         std::sqrt(area_of_ring(low, n) * area_of_ring(at, n)));
    EXPECT_NEAR(frustum.section(z), area_of_ring(at, n),
                exact * area_of_ring(at, n));
    EXPECT_NEAR(frustum.volume_below(z), volume, exact * volume);
    EXPECT_NEAR(frustum.height_of(volume), z, 1e-12);
  }
}

// Corners at many heights: the section is the derivative of the volume.
TEST(Container, SectionIsTheDerivativeOfTheVolume)
{
  dem::TriangleMesh mesh =
      cup({{0., 0.05}, {0.03, 0.06}, {0.07, 0.08}, {0.1, 0.09}}, 9);
  for (std::size_t k = 9; k < 27; ++k)
    mesh.points[k].z() += 0.008 * std::sin(3. * double(k));
  const dem::Container any = container(mesh);
  constexpr double h = 1e-6;
  for (double z = 0.0013; z < 0.1; z += 0.0037)
    EXPECT_NEAR((any.volume_below(z + h) - any.volume_below(z - h)) / (2. * h),
                any.section(z), 1e-7 * any.section(z))
        << z;
}

TEST(Container, NormalsOfTheFileDoNotMatter)
{
  dem::TriangleMesh mesh = cup({{0., 0.05}, {0.1, 0.06}}, 8);
  const double volume = container(mesh).volume_below(0.1);
  for (auto &corners : mesh.triangles)
    std::swap(corners[0], corners[1]);
  const dem::Container turned = container(mesh);
  EXPECT_EQ(turned.volume_below(0.1), volume);
  EXPECT_TRUE(turned.holds({0.3, -0.2, 0.03}, 0.02));
}

TEST(Container, SpheresInsideAreHeld)
{
  const dem::Container cylinder = container(cup({{0., 0.05}, {0.1, 0.05}}, 32));
  const Vec3 middle(0.3, -0.2, 0.05);
  EXPECT_TRUE(cylinder.holds(middle, 0.049));
  EXPECT_FALSE(cylinder.holds(middle, 0.051));
  EXPECT_FALSE(cylinder.holds(middle + 0.04 * Vec3::UnitX(), 0.011));
  EXPECT_FALSE(cylinder.holds(middle + 0.07 * Vec3::UnitX(), 0.01));
  EXPECT_FALSE(cylinder.holds(middle - 0.07 * Vec3::UnitZ(), 0.01));
  // In the collar, which is as high as the container.
  EXPECT_TRUE(cylinder.holds(middle + 0.1 * Vec3::UnitZ(), 0.04));
  EXPECT_FALSE(cylinder.holds(middle + Vec3(0.06, 0., 0.1), 0.005));
}

TEST(Container, CollarRisesFromTheRim)
{
  dem::Container box = container(cup({{0., 0.05}, {0.1, 0.05}}, 4));
  box.set_collar(0.7);
  double top = 0.;
  for (const Vec3 &point : box.wall().position)
    top = std::max(top, point.z());
  EXPECT_NEAR(top, 0.8, exact);
  EXPECT_TRUE(box.holds({0.3, -0.2, 0.7}, 0.02));
  EXPECT_NEAR(box.volume_below(0.1), area_of_ring(0.05, 4) * 0.1, 1e-15);
}

TEST(Container, WhatIsNoneIsRefused)
{
  const dem::TriangleMesh sound = cup({{0., 0.05}, {0.1, 0.06}}, 8);
  EXPECT_EQ(refusal(sound), "");
  dem::TriangleMesh leaking = sound;
  leaking.triangles.erase(leaking.triangles.begin() + 7);
  EXPECT_NE(refusal(leaking).find("leaks"), std::string::npos)
      << refusal(leaking);
  EXPECT_NE(refusal(cup({{0., 0.06}, {0.1, 0.05}}, 8)).find("narrows"),
            std::string::npos);
  EXPECT_NE(
      refusal(cup({{0., 0.05}, {0.05, 0.08}, {0.1, 0.06}}, 8)).find("narrows"),
      std::string::npos);
  // Inner and outer surface of a wall with thickness.
  dem::TriangleMesh thick = sound;
  for (const Vec3 &point : cup({{-0.01, 0.06}, {0.1, 0.07}}, 8).points)
    thick.points.push_back(point);
  for (const auto &corners : sound.triangles)
    thick.triangles.push_back(
        {corners[0] + 16, corners[2] + 16, corners[1] + 16});
  EXPECT_NE(refusal(thick).find("pieces"), std::string::npos);
  for (std::int32_t k = 0; k < 8; ++k) // the rim joins them
  {
    const std::int32_t a = 8 + k, b = 8 + (k + 1) % 8;
    thick.triangles.push_back({a, b, b + 16});
    thick.triangles.push_back({a, b + 16, a + 16});
  }
  EXPECT_NE(refusal(thick).find("2 open rims"), std::string::npos)
      << refusal(thick);
  // A pyramid with its tip up.
  dem::TriangleMesh pyramid = cup({{0., 0.05}}, 4);
  pyramid.points.push_back({0.3, -0.2, 7.1});
  for (std::int32_t k = 0; k < 4; ++k)
    pyramid.triangles.push_back({k, (k + 1) % 4, 4});
  EXPECT_NE(refusal(pyramid).find("flat lid"), std::string::npos);
}

// What is at z = 0 closes the volume. Floor and lid of a file are taken off.
TEST(OpenContainer, HoldsTheVolumeAboveItsFoot)
{
  constexpr int n = 12;
  const double low = 0.05, high = 0.09, height = 0.2;
  const dem::TriangleMesh cone = cup({{0., low}, {height, high}}, n);
  for (const dem::TriangleMesh &mesh :
       {tube(cone, n), cone, with_lid(cone, n), tube(with_lid(cone, n), n)})
  {
    const dem::Container any = container(mesh, no_floor);
    EXPECT_NEAR(dem::polygon_area(any.foot()), area_of_ring(low, n), exact);
    for (const double z : {0.01, 0.07, 0.2, 0.3})
    {
      const double up = std::min(z, height);
      const double at = low + (high - low) * up / height;
      const double volume =
          up / 3. *
              (area_of_ring(low, n) + area_of_ring(at, n) +
               std::sqrt(area_of_ring(low, n) * area_of_ring(at, n))) +
          (z - up) * area_of_ring(high, n);
      EXPECT_NEAR(any.section(z), area_of_ring(at, n), exact);
      EXPECT_NEAR(any.volume_below(z), volume, exact * volume);
      EXPECT_NEAR(any.height_of(volume), z, 1e-12);
    }
    EXPECT_EQ(any.volume_below(-0.1), 0.);
  }
}

// A foot like an L, whose area is that of three squares, and walls that lean:
// sections keep their area (Cavalieri).
TEST(OpenContainer, AnyFootWillDo)
{
  const std::vector<Eigen::Vector2d> foot{{0., 0.},   {0.2, 0.},  {0.2, 0.1},
                                          {0.1, 0.1}, {0.1, 0.2}, {0., 0.2}};
  const auto n = static_cast<std::int32_t>(foot.size());
  dem::TriangleMesh mesh;
  for (const double z : {0., 0.3})
    for (const Eigen::Vector2d &corner : foot)
      mesh.points.push_back({corner.x() + 0.1 * z, corner.y(), z});
  for (std::int32_t k = 0; k < n; ++k)
  {
    const std::int32_t next = (k + 1) % n;
    mesh.triangles.push_back({k, next, next + n});
    mesh.triangles.push_back({k, next + n, k + n});
  }
  const dem::Container any = container(mesh, no_floor);
  for (const double z : {0.1, 0.3})
  {
    EXPECT_NEAR(any.section(z), 0.03, exact);
    EXPECT_NEAR(any.volume_below(z), 0.03 * z, exact);
  }
  EXPECT_TRUE(any.holds({0.16, 0.05, 0.1}, 0.03));
  EXPECT_TRUE(any.holds({0.16, 0.05, 0.1}, 0.)); // a point
  EXPECT_FALSE(any.holds({0.16, 0.15, 0.1}, 0.));
  EXPECT_FALSE(any.holds({0.16, 0.15, 0.1}, 0.03));  // in its notch
  EXPECT_FALSE(any.holds({0.16, 0.05, 0.02}, 0.03)); // the foot is at z = 0
}

// Walls go on below the foot, so that what lies there may sink.
TEST(OpenContainer, WallsContinueDown)
{
  const dem::Container any =
      container(tube(cup({{0., 0.05}, {0.1, 0.06}}, 8), 8), no_floor);
  double lowest = 0., highest = 0.;
  for (const Vec3 &point : any.wall().position)
  {
    lowest = std::min(lowest, point.z());
    highest = std::max(highest, point.z());
  }
  EXPECT_NEAR(lowest, -0.1, exact);
  EXPECT_NEAR(highest, 0.2, exact);
  // All facets show outward.
  for (const auto &corners : any.wall().triangles)
  {
    const auto at = [&](std::size_t k) -> const Vec3 &
    { return any.wall().position[static_cast<std::size_t>(corners[k])]; };
    const Vec3 out = (at(1) - at(0)).cross(at(2) - at(0));
    EXPECT_GT(out.dot((at(0) + at(1) + at(2)) / 3. - Vec3(0.3, -0.2, 0.)), 0.);
  }
}

TEST(OpenContainer, ColumnsFitOrNot)
{
  const dem::Container round = container(
      tube(cup({{0., 0.1}, {0.3, 0.12}}, 64, Vec3::Zero()), 64), no_floor);
  const auto square = [](double half, double x)
  {
    return dem::Polygon{{x - half, -half},
                        {x + half, -half},
                        {x + half, half},
                        {x - half, half}};
  };
  // Flat sides are nearer than the corners by 1 - cos(pi / 64) = 0.12 %.
  const double largest = 0.1 * std::cos(std::numbers::pi / 64.) / std::sqrt(2.);
  EXPECT_TRUE(round.holds_column(square(0.998 * largest, 0.)));
  EXPECT_FALSE(round.holds_column(square(1.004 * largest, 0.)));
  EXPECT_TRUE(round.holds_column(square(0.03, 0.06)));
  EXPECT_FALSE(round.holds_column(square(0.03, 0.08)));
  EXPECT_FALSE(round.holds_column(square(0.03, 0.3)));
  // As wide as a box, and a box that leans: outside of it further up.
  const auto box = [](double lean)
  {
    dem::TriangleMesh mesh = tube(
        cup({{0., 0.1 * std::sqrt(2.)}, {0.3, 0.1 * std::sqrt(2.)}}, 4), 4);
    for (Vec3 &point : mesh.points)
    {
      point -= Vec3(0.3, -0.2, 7.);
      point = Eigen::AngleAxisd(0.25 * std::numbers::pi, Vec3::UnitZ()) * point;
      point.x() += lean * point.z();
    }
    return container(mesh, no_floor);
  };
  EXPECT_TRUE(box(0.).holds_column(square(0.1, 0.)));
  EXPECT_FALSE(box(0.).holds_column(square(0.101, 0.)));
  EXPECT_FALSE(box(0.1).holds_column(square(0.09, 0.)));
  EXPECT_TRUE(box(0.1).holds_column(square(0.06, 0.)));
  // A column under the overhang alone, whose wall covers it wholly.
  EXPECT_FALSE(box(1.).holds_column(square(0.01, -0.05)));
}

TEST(OpenContainer, WhatIsNoneIsRefused)
{
  constexpr int n = 8;
  const dem::TriangleMesh sound = tube(cup({{0., 0.05}, {0.1, 0.06}}, n), n);
  EXPECT_EQ(refusal(sound, no_floor), "");
  EXPECT_NE(refusal(sound).find("leaks"), std::string::npos); // no floor
  dem::TriangleMesh leaking = sound;
  leaking.triangles.erase(leaking.triangles.begin() + 5);
  EXPECT_NE(refusal(leaking, no_floor)
                .find("leaks: it is open from 0 m to 0.1 m above its lowest"),
            std::string::npos)
      << refusal(leaking, no_floor);
  for (const std::size_t corner : {3, 11}) // of the lower and the upper rim
  {
    dem::TriangleMesh uneven = sound;
    uneven.points[corner].z() += corner == 3 ? 0.01 : -0.01;
    EXPECT_NE(refusal(uneven, no_floor).find("must be open at flat rims"),
              std::string::npos)
        << refusal(uneven, no_floor);
  }
  // A floor with a tip, which is no flat one.
  dem::TriangleMesh bowl = sound;
  bowl.points.push_back({0.3, -0.2, 6.97});
  for (std::int32_t k = 0; k < n; ++k)
    bowl.triangles.push_back({k, 2 * n, (k + 1) % n});
  EXPECT_NE(refusal(bowl, no_floor).find("closed without a flat floor"),
            std::string::npos)
      << refusal(bowl, no_floor);
  EXPECT_NE(refusal(tube(cup({{0., 0.06}, {0.1, 0.05}}, n), n), no_floor)
                .find("narrows"),
            std::string::npos);
  // Trousers: two legs on the ground.
  dem::TriangleMesh legs = cup({{0., 0.05}, {0.1, 0.06}}, n);
  legs.triangles.erase(legs.triangles.begin());
  legs.triangles.erase(legs.triangles.begin() + n - 4);
  EXPECT_NE(refusal(legs, no_floor), "");
}
} // namespace
