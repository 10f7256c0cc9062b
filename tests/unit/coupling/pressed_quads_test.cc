#include <coupling/pressed_quads.h>

#include <gtest/gtest.h>

namespace
{
using coupling::pressed_quads;

/// Quads of 0.05 m: number i + 8 k lies in column i round the box, row k.
const fem::SurfaceMesh box =
    fem::box_sides({0., 0., 0.}, {0.1, 0.1, 0.2}, {2, 2, 4});

std::vector<std::int32_t> pressed_at(const dem::Vec3 &point)
{
  dem::Network network;
  network.walls.push_back({0, point});
  return pressed_quads(box, network);
}

TEST(PressedQuads, AreThoseAtTheContacts)
{
  const std::vector<std::int32_t> none;
  EXPECT_EQ(pressed_at({0.025, 0., 0.025}), std::vector<std::int32_t>{0});
  EXPECT_EQ(pressed_at({0.1, 0.075, 0.125}), std::vector<std::int32_t>{19});
  // Near an edge both press, in a corner of the box too; near a node, four.
  EXPECT_EQ(pressed_at({0.025, 0., 0.049}), (std::vector<std::int32_t>{0, 8}));
  EXPECT_EQ(pressed_at({0.1, 0.001, 0.025}), (std::vector<std::int32_t>{1, 2}));
  EXPECT_EQ(pressed_at({0.05, 0.1, 0.1}),
            (std::vector<std::int32_t>{12, 13, 20, 21}));
  // In the middle of a platen.
  EXPECT_EQ(pressed_at({0.05, 0.05, 0.}), none);
  EXPECT_EQ(pressed_quads(box, {}), none);
}
} // namespace
