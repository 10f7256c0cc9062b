#include "neighbor/place_lists.h"

#include <gtest/gtest.h>

namespace
{
/// Places all round the equator, `gap` from touching [m].
dem::ContactPoint place(int number, double gap)
{
  const double angle = 0.5 * number;
  return {
      {std::cos(angle), std::sin(angle), 0.}, dem::Vec3::UnitZ(), -gap, true};
}

/// As many old places as a pair may have, 1e-5 m and more from touching.
dem::PairList full_list()
{
  dem::PairList list;
  list.clear = 1e-3;
  for (int k = 0; k < static_cast<int>(dem::most_contact_points); ++k)
    list.keep({k, place(k, 1e-5 * (k + 1)), {}});
  return list;
}
} // namespace

// A place where two particles overlap is never left out for one where they are
// apart.
TEST(PlaceLists, OfTooManyThePlacesFarthestFromTouchingGo)
{
  dem::PairList list = full_list();
  list.add({place(9, -1e-6), place(10, 1.)}, false);
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

TEST(PlaceLists, AtOnePlaceThereIsOneContact)
{
  dem::PairList list;
  list.keep({0, place(1, -1e-6), {}});
  list.keep({1, place(1, -2e-6), {}});
  EXPECT_EQ(list.rows.size(), 1u);
  EXPECT_EQ(list.events.n_merged, 1);
}
