#include "neighbor/local_renewal.h"

#include <gtest/gtest.h>

namespace
{
using Numbers = std::vector<std::size_t>;

/// Contacts that follow their surfaces, between these particles.
dem::ContactBatch contacts_of(const std::vector<dem::PairKey> &keys)
{
  dem::BatchLayout layout;
  layout.has_sides = layout.has_partners = layout.has_contact_points = true;
  dem::ContactBatch batch;
  batch.rearrange(layout, std::vector<std::int32_t>(keys.size(), -1));
  for (std::size_t k = 0; k < keys.size(); ++k)
  {
    batch.a[k] = keys[k].first;
    batch.b[k] = keys[k].second;
  }
  return batch;
}

dem::Row row_from(std::int32_t source)
{
  return {source, {dem::Vec3::UnitX(), -dem::Vec3::UnitX(), 0., true}, {}};
}

/// The pair of contact `number` gets these rows.
struct OnePair
{
  std::vector<std::int32_t> contacts;
  std::vector<dem::CandidatePair> pairs;
  dem::Renewal made;

  OnePair(const dem::ContactBatch &batch, std::int32_t number,
          const std::vector<dem::Row> &rows)
      : contacts{number}, pairs{{{batch.a[dem::row_of(number)],
                                  batch.b[dem::row_of(number)]},
                                 0.,
                                 0.,
                                 dem::Vec3::Zero()}}
  {
    made.old = {dem::OldRows(contacts)};
    made.due = {0};
    made.lists.resize(1);
    made.lists[0].rows = rows;
  }
};
} // namespace

TEST(LocalRenewal, LooksAtAllContactsOfTheDisplacedPairs)
{
  dem::ContactBatch batch =
      contacts_of({{0, 1}, {0, 2}, {0, 1}, {1, 2}, {0, 2}, {0, 1}});
  EXPECT_TRUE(dem::of_displaced_pairs(batch).empty());
  batch.displaced[2] = 1;
  EXPECT_EQ(dem::of_displaced_pairs(batch),
            (std::vector<std::int32_t>{0, 2, 5}));
  batch.vacate(5);
  EXPECT_EQ(dem::of_displaced_pairs(batch), (std::vector<std::int32_t>{0, 2}));
}

TEST(LocalRenewal, ANewContactTakesTheEntryOfADroppedOne)
{
  const dem::ContactBatch batch = contacts_of({{0, 1}, {0, 2}, {1, 2}});
  const OnePair pair(batch, 1, {row_from(-1)});
  const dem::LocalChanges changes(pair.pairs, pair.made, batch);
  ASSERT_TRUE(changes.has_room());
  EXPECT_EQ(changes.dropped(), Numbers{1});
  ASSERT_EQ(changes.added().size(), 1u);
  EXPECT_EQ(changes.added()[0].entry, 1u);
}

// Though another pair may have taken the old entry by then.
TEST(LocalRenewal, ANewContactAddsItsLoadsWhereItsPairDid)
{
  dem::ContactBatch batch = contacts_of({{0, 1}, {0, 2}, {1, 2}});
  batch.target = {1, 2, -5};
  batch.target.resize(dem::ContactBatch::block);
  const OnePair pair(batch, 2, {row_from(-1)});
  EXPECT_EQ(dem::LocalChanges(pair.pairs, pair.made, batch).added()[0].target,
            -5);
}

TEST(LocalRenewal, AKeptContactStays)
{
  const dem::ContactBatch batch = contacts_of({{0, 1}, {0, 2}, {1, 2}});
  const OnePair pair(batch, 1, {row_from(1)});
  const dem::LocalChanges changes(pair.pairs, pair.made, batch);
  EXPECT_TRUE(changes.has_room());
  EXPECT_TRUE(changes.dropped().empty());
  EXPECT_TRUE(changes.added().empty());
}

TEST(LocalRenewal, WithoutAVacantEntryThereIsNoRoom)
{
  dem::ContactBatch batch = contacts_of({{0, 1}, {0, 2}, {1, 2}});
  const OnePair pair(batch, 1, {row_from(1), row_from(-1)});
  EXPECT_FALSE(dem::LocalChanges(pair.pairs, pair.made, batch).has_room());
  batch.vacate(2);
  const dem::LocalChanges changes(pair.pairs, pair.made, batch);
  ASSERT_TRUE(changes.has_room());
  EXPECT_EQ(changes.added()[0].entry, 2u);
}

// Loads are summed by the particle of the first entry of each range.
TEST(LocalRenewal, TheFirstEntryOfARangeKeepsItsParticle)
{
  dem::ContactBatch batch = contacts_of({{0, 1}, {0, 2}, {1, 2}});
  batch.vacate(0);
  const OnePair other(batch, 2, {row_from(2), row_from(-1)});
  EXPECT_FALSE(dem::LocalChanges(other.pairs, other.made, batch).has_room());
  const OnePair same(batch, 1, {row_from(1), row_from(-1)});
  EXPECT_TRUE(dem::LocalChanges(same.pairs, same.made, batch).has_room());
}

// Loads on B go where those of the pair in that range do, see PairLoads.
TEST(LocalRenewal, AnEntryOfAnotherRangeIsNotTaken)
{
  std::vector<dem::PairKey> keys(200, dem::PairKey{0, 1});
  dem::ContactBatch batch = contacts_of(keys);
  const auto range = static_cast<std::size_t>(dem::range_size(200));
  ASSERT_LT(range + 1, batch.size());
  batch.vacate(range + 1);
  const OnePair pair(batch, 1, {row_from(1), row_from(-1)});
  EXPECT_FALSE(dem::LocalChanges(pair.pairs, pair.made, batch).has_room());
}
