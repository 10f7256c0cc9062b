#include <dem/contact/batch.h>

#include <gtest/gtest.h>

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

TEST(ContactBatch, HasNoPairWithoutContacts)
{
  dem::for_each_pair(dem::ContactBatch{},
                     [](const auto &) { FAIL() << "a pair of nothing"; });
}

// What is known about a direction, moved to where the contact has come on the
// surface: the value there, and the slope by differences of it.
TEST(SideColumns, ExpansionMovesWithTheContactPoint)
{
  dem::SideColumns side;
  const dem::Vec3 u = dem::Vec3(0.3, -0.2, 0.9).normalized();
  side.direction = {{static_cast<dem::Narrow>(u.x())},
                    {static_cast<dem::Narrow>(u.y())},
                    {static_cast<dem::Narrow>(u.z())}};
  side.radius = {0.012};
  side.gradient = {{0.002f}, {-0.001f}, {0.0005f}};
  side.hessian = {
      {{0.003f}, {-0.002f}, {0.001f}, {0.0007f}, {0.0004f}, {-0.0006f}}};
  side.offset = {{0.05f}, {0.08f}, {-0.03f}};
  const dem::RadialExpansion there = side.expansion_at_contact_point(0);
  const dem::Vec3 &s = there.direction;
  const auto radius = [&side](const dem::Vec3 &at) {
    return side.local_radius(0, {at.x(), at.y(), at.z()});
  };
  EXPECT_NEAR((s - side.contact_point(0)).norm(), 0., 1e-15);
  EXPECT_NEAR(there.radius, radius(s), 1e-15);
  EXPECT_NEAR(there.gradient.dot(s), 0., 1e-15);
  const dem::Vec3 along = s.cross(dem::Vec3::UnitX()).normalized();
  const double step = 1e-4;
  for (const dem::Vec3 &t : {along, dem::Vec3(s.cross(along))})
    EXPECT_NEAR(there.gradient.dot(t),
                (radius(s + step * t) - radius(s - step * t)) / (2. * step),
                1e-12);
}
