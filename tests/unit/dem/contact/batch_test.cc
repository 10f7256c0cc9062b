#include "../shape/test_shapes.h"

#include <dem/contact/batch.h>

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <utility>
#include <vector>

// Contact points of one pair of true surfaces stand where they touch first,
// apart from each other: they count as one pair all the same, in their order.
TEST(ContactBatch, GathersTheContactsOfAPairFromAnywhere)
{
  dem::ContactBatch pairs;
  pairs.a = {2, 0, 2, 0, 1, 2};
  pairs.b = {3, 2, 4, 1, 2, 3};
  pairs.set_size(6);
  using Entries = std::vector<std::int32_t>;
  std::vector<std::pair<std::pair<int, int>, Entries>> found;
  dem::for_each_pair(
      pairs,
      [&](const auto &entries)
      {
        const auto first = static_cast<std::size_t>(entries.front());
        found.push_back({{pairs.a[first], pairs.b[first]},
                         Entries(entries.begin(), entries.end())});
      });
  const decltype(found) expected = {{{0, 1}, {3}},
                                    {{0, 2}, {1}},
                                    {{1, 2}, {4}},
                                    {{2, 3}, {0, 5}},
                                    {{2, 4}, {2}}};
  EXPECT_EQ(found, expected);
}

TEST(ContactBatch, AVacantEntryIsInNoListUntilAContactStartsThere)
{
  dem::BatchLayout layout;
  layout.has_sides = layout.has_partners = layout.has_contact_points = true;
  dem::ContactBatch batch;
  batch.rearrange(layout, {-1, -1, -1});
  for (std::size_t k = 0; k < 3; ++k)
    batch.start(k, 0, static_cast<std::int32_t>(k) + 1);
  batch.overlap[1] = 1e-6;
  batch.normal_force[1] = batch.shear.y[1] = 2.;
  batch.side_b.height[1] = 0.01;
  batch.target[1] = -3;
  batch.vacate(1);
  EXPECT_TRUE(batch.is_vacant(1));
  EXPECT_EQ(batch.n_vacant(), 1u);
  EXPECT_EQ(batch.by_pair(), (std::vector<std::int32_t>{0, 2}));
  EXPECT_FALSE(batch.has_force(1));
  EXPECT_EQ(batch.stored_energy(1), 0.);
  EXPECT_EQ(batch.side_b.height[1], 0.01);
  EXPECT_EQ(batch.target[1], -3);
  batch.start(1, 0, 4);
  EXPECT_EQ(batch.n_vacant(), 0u);
  EXPECT_EQ(batch.side_b.height[1], 0.);
  EXPECT_EQ(batch.by_pair(), (std::vector<std::int32_t>{0, 2, 1}));
  EXPECT_EQ(batch.target[1], -3);
}

TEST(ContactBatch, HasNoPairWithoutContacts)
{
  dem::for_each_pair(dem::ContactBatch{},
                     [](const auto &) { FAIL() << "a pair of nothing"; });
}

namespace
{
/// A side with room for one contact that follows its surface.
dem::SideColumns empty_side()
{
  dem::SideColumns side;
  const std::vector<dem::Narrow> one(1);
  side.direction = {one, one, one};
  side.normal = {one, one, one};
  side.height.resize(1);
  side.aside = {one, one};
  side.shape_operator = {one, one, one};
  side.offset = {one, one};
  return side;
}
} // namespace

// Columns take a surface as it is, but for the digits of floats along it.
TEST(SideColumns, KeepTheParaboloid)
{
  dem::RadialExpansion at;
  at.direction = dem::Vec3(0.3, -0.2, 0.9).normalized();
  at.radius = 0.012;
  at.gradient = dem::Vec3(0.002, 0.003, 0.).cross(at.direction);
  const dem::Mat3 across =
      dem::Mat3::Identity() - at.direction * at.direction.transpose();
  at.hessian = across * dem::Vec3(0.003, -0.002, 0.001).asDiagonal() * across;
  const dem::SurfacePoint point = dem::surface_point(at);
  dem::SideColumns side = empty_side();
  EXPECT_FALSE(side.is_known(0));
  side.set_paraboloid(0, point);
  EXPECT_TRUE(side.is_known(0));
  const dem::SurfacePoint found = side.paraboloid(0).vertex;
  EXPECT_NEAR((found.normal - point.normal).norm(), 0., 2e-7);
  EXPECT_NEAR((found.position - point.position).norm(), 0., 2e-7 * at.radius);
  EXPECT_NEAR((found.position - point.position).dot(point.normal), 0.,
              1e-13 * at.radius);
  EXPECT_NEAR((found.shape_operator - point.shape_operator).norm() * at.radius,
              0., 1e-6);
  EXPECT_NEAR((side.contact_point(0) - at.direction).norm(), 0., 2e-7);
}

// The point of a paraboloid that a direction meets, with the normal that
// differences of positions give.
TEST(Paraboloid, HasThePointTowardsADirection)
{
  dem::Paraboloid surface;
  surface.vertex.normal = dem::Vec3(0.1, 0.3, -0.8).normalized();
  const dem::Vec3 &n = surface.vertex.normal;
  const dem::Mat3 across = dem::Mat3::Identity() - n * n.transpose();
  surface.vertex.position = dem::Vec3(0.002, 0.003, -0.011);
  surface.vertex.shape_operator =
      across * dem::Vec3(120., 60., 200.).asDiagonal() * across;
  const auto towards = [&surface](const dem::Vec3 &direction)
  { return surface.at(surface.offset_towards(direction)); };
  const dem::Vec3 u =
      (surface.vertex.position + across * dem::Vec3(1e-4, -5e-5, 8e-5))
          .normalized();
  const dem::SurfacePoint there = towards(u);
  EXPECT_NEAR(there.position.cross(u).norm(), 0., 1e-13);
  EXPECT_NEAR(there.normal.norm(), 1., 1e-15);
  const double step = 1e-5;
  for (const dem::Vec3 &t :
       {dem::Vec3(dem::Vec3::UnitX()), dem::Vec3(dem::Vec3::UnitY())})
  {
    const dem::Vec3 chord = towards((u + step * t).normalized()).position -
                            towards((u - step * t).normalized()).position;
    EXPECT_NEAR(there.normal.dot(chord) / chord.norm(), 0., 1e-8);
  }
}

// At the usual tolerance a paraboloid is off the surface by what the expansion
// of the radius to second order is: 6.8e-8 and 7.0e-8 of the radius.
TEST(Paraboloid, IsAsNearAsTheExpansion)
{
  double paraboloid = 0., expansion = 0.;
  int n = 0;
  for (unsigned seed = 1; seed <= 4; ++seed)
  {
    const std::vector<double> series = dem::test::random_particle(12, seed);
    for (const dem::Vec3 &s : dem::test::random_directions(200, seed))
    {
      const dem::RadialExpansion at = dem::expand(series, s);
      const dem::Paraboloid surface{dem::surface_point(at)};
      const dem::Vec3 w =
          5e-3 * surface.height() * surface.vertex.normal.unitOrthogonal();
      const dem::Vec3 x = surface.at(w).position, to = x.normalized();
      const double exact = dem::expand(series, to).radius;
      const dem::Vec3 u = to / to.dot(s) - s;
      const double second =
          at.radius + at.gradient.dot(u) + 0.5 * u.dot(at.hessian * u);
      paraboloid += std::pow((x.norm() - exact) / exact, 2);
      expansion += std::pow((second - exact) / exact, 2);
      ++n;
    }
  }
  RecordProperty("paraboloid", std::to_string(std::sqrt(paraboloid / n) * 1e9));
  RecordProperty("expansion", std::to_string(std::sqrt(expansion / n) * 1e9));
  EXPECT_LT(paraboloid, 4. * expansion);
}
