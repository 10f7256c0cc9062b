#include "test/removed_mass.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <array>
#include <sstream>

namespace
{
dem::BreakageEvent event(int kind, std::int64_t other, double volume)
{
  dem::BreakageEvent one;
  one.kind = kind;
  one.other = other;
  one.removed_volume = volume;
  return one;
}
} // namespace

// By boundary, with all other particles in one.
TEST(RemovedMass, IsAddedByBoundary)
{
  spall::RemovedMass mass;
  const std::array events = {event(0, 3, 1e-9), event(0, 7, 2e-9),
                             event(1, 0, 4e-9), event(1, 2, 8e-9),
                             event(3, -1, 16e-9)};
  mass.add(events, 2000.);
  EXPECT_DOUBLE_EQ(mass.on(0, -1), 6e-6);
  EXPECT_DOUBLE_EQ(mass.on(1, 2), 16e-6);
  EXPECT_EQ(mass.on(1, 1), 0.);
  std::stringstream state;
  mass.save(state);
  spall::RemovedMass again;
  again.restore(state);
  nlohmann::ordered_json summary;
  const std::array named = {
      spall::NamedBoundary{"base", spall::BoundaryKind::plane, 2}};
  again.summarise(dem::Engine(dem::EngineParameters{}), named, summary);
  const auto &masses = summary["removed_mass_kg"];
  EXPECT_EQ(masses.size(), 4u);
  EXPECT_DOUBLE_EQ(masses["particles"], 6e-6);
  EXPECT_DOUBLE_EQ(masses["plane_0"], 8e-6);
  EXPECT_DOUBLE_EQ(masses["base"], 16e-6);
  EXPECT_DOUBLE_EQ(masses["drum"], 32e-6);
}
