#include <dem/contact/batch.h>

#include <gtest/gtest.h>

#include <utility>
#include <vector>

// Places of one pair of true surfaces stand where they touch first, apart from
// each other: they count as one pair all the same, in their order.
TEST(ContactBatch, GathersThePlacesOfAPairFromAnywhere)
{
  dem::ContactBatch pairs;
  pairs.a = {2, 0, 2, 0, 1, 2};
  pairs.b = {3, 2, 4, 1, 2, 3};
  pairs.set_size(6);
  using Places = std::vector<std::int32_t>;
  std::vector<std::pair<std::pair<int, int>, Places>> found;
  dem::for_each_pair(pairs,
                     [&](const auto &places)
                     {
                       const auto first =
                           static_cast<std::size_t>(places.front());
                       found.push_back({{pairs.a[first], pairs.b[first]},
                                        Places(places.begin(), places.end())});
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
