#include <dem/boundary/facet_surface.h>

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>
#include <string>

using dem::FacetSurface;
using dem::FacetTopology;
using dem::Vec3;

namespace
{
/// Two triangles of a unit square.
FacetSurface square()
{
  FacetSurface surface;
  surface.position = {Vec3(0., 0., 0.), Vec3(1., 0., 0.), Vec3(1., 1., 0.),
                      Vec3(0., 1., 0.)};
  surface.triangles = {{0, 1, 2}, {0, 2, 3}};
  return surface;
}

std::string message_of(const FacetSurface &surface)
{
  try
  {
    FacetTopology topology(surface);
  }
  catch (const std::invalid_argument &error)
  {
    return error.what();
  }
  return "";
}
} // namespace

TEST(FacetTopology, NeighboursAndRims)
{
  const FacetTopology topology(square());
  EXPECT_EQ(topology.neighbour[0], (std::array<std::int32_t, 3>{-1, -1, 1}));
  EXPECT_EQ(topology.neighbour[1], (std::array<std::int32_t, 3>{0, -1, -1}));
}

TEST(FacetTopology, RowsHoldTheTrianglesRoundAVertex)
{
  const FacetTopology topology(square());
  EXPECT_EQ(topology.row_start, (std::vector<std::int32_t>{0, 2, 3, 5, 6}));
  EXPECT_EQ(topology.row_triangle,
            (std::vector<std::int32_t>{0, 1, 0, 0, 1, 1}));
}

TEST(FacetTopology, EmptySurface)
{
  const FacetTopology topology(FacetSurface{});
  EXPECT_TRUE(topology.neighbour.empty());
  EXPECT_TRUE(topology.row_triangle.empty());
}

TEST(FacetTopology, BadMeshesAreNamed)
{
  FacetSurface surface = square();
  surface.triangles[1][2] = 4;
  EXPECT_EQ(message_of(surface), "facet 1 names vertex 4; 0 to 3 are allowed");
  surface.triangles[1][2] = 2;
  EXPECT_EQ(message_of(surface), "facet 1 names vertex 2 twice; three "
                                 "different vertices are needed");
  surface = square();
  surface.position[1] = Vec3(0.4, 0.4, 0.);
  EXPECT_EQ(message_of(surface), "facet 0 has no area; its height must be "
                                 "more than 1e-09 of its longest side");
  surface.position[1].x() = std::nan("");
  EXPECT_NE(message_of(surface).find("facet 0 has no area"), std::string::npos);
  surface = square();
  surface.triangles[1] = {0, 3, 2};
  EXPECT_NE(message_of(surface).find("opposite orientation"),
            std::string::npos);
  surface = square();
  surface.position.push_back(Vec3(0., 0., 1.));
  surface.triangles.push_back({2, 0, 4});
  EXPECT_NE(message_of(surface).find("at most two are allowed"),
            std::string::npos);
}
