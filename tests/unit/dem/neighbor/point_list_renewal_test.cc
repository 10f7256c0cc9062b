#include "neighbor/point_list_renewal.h"

#include <gtest/gtest.h>

namespace
{
/// Contact points all round the equator, `gap` from touching [m].
dem::ContactPoint contact_point(int number, double gap)
{
  const double angle = 0.5 * number;
  return {
      {std::cos(angle), std::sin(angle), 0.}, dem::Vec3::UnitZ(), -gap, true};
}

/// As many old contact points as a pair may have, 1e-5 m and more from
/// touching.
dem::PairList full_list()
{
  dem::PairList list;
  list.clear = 1e-3;
  for (int k = 0; k < static_cast<int>(dem::most_contact_points); ++k)
    list.keep({k, contact_point(k, 1e-5 * (k + 1)), {}});
  return list;
}
} // namespace

// A contact point with overlap is never left out for one where they are
// apart.
TEST(PointListRenewal, OfTooManyThePointsFarthestFromTouchingGo)
{
  dem::PairList list = full_list();
  list.add({contact_point(9, -1e-6), contact_point(10, 1.)}, false);
  ASSERT_EQ(list.rows.size(), dem::most_contact_points);
  EXPECT_EQ(list.rows.back().contact_point.overlap, 1e-6);
  EXPECT_EQ(list.rows.back().source, -1);
  for (int k = 0; k + 1 < static_cast<int>(dem::most_contact_points); ++k)
    EXPECT_EQ(list.rows[static_cast<std::size_t>(k)].source, k);
  EXPECT_EQ(list.events.n_unlisted, 2);
  EXPECT_EQ(list.events.n_late, 1);
  // Until the nearest of those that went could touch.
  EXPECT_EQ(list.clear, 1e-5 * static_cast<double>(dem::most_contact_points));
}

TEST(PointListRenewal, AtOnePointThereIsOneContact)
{
  dem::PairList list;
  list.keep({0, contact_point(1, -1e-6), {}});
  list.keep({1, contact_point(1, -2e-6), {}});
  EXPECT_EQ(list.rows.size(), 1u);
  EXPECT_EQ(list.events.n_merged, 1);
}
