#include <dem/boundary/wall_clearance.h>
#include <dem/boundary/wall_mesh.h>

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>
#include <string>

using dem::FacetSurface;
using dem::TriangleMesh;
using dem::Vec3;
using dem::WallSide;

namespace
{
/// A cube of side one, its triangles outward but for the first.
TriangleMesh cube_with_one_turned()
{
  TriangleMesh mesh;
  for (int k = 0; k < 8; ++k)
    mesh.points.emplace_back(k & 1, (k >> 1) & 1, (k >> 2) & 1);
  mesh.triangles = {{0, 1, 3}, {0, 3, 2}, {4, 5, 7}, {4, 7, 6},
                    {0, 1, 5}, {0, 5, 4}, {2, 7, 3}, {2, 6, 7},
                    {0, 6, 2}, {0, 4, 6}, {1, 3, 7}, {1, 7, 5}};
  std::swap(mesh.triangles[1][1], mesh.triangles[1][2]);
  return mesh;
}

/// Two triangles of the plane z = 0 without common points, as in an STL file;
/// normals up, of the second one down if `turned`.
TriangleMesh floor_of_stl(bool turned)
{
  TriangleMesh mesh;
  mesh.points = {{0., 0., 0.}, {2., 0., 0.}, {2., 2., 0.},
                 {0., 0., 0.}, {2., 2., 0.}, {0., 2., 0.}};
  mesh.triangles = {{0, 1, 2}, {3, 4, 5}};
  if (turned)
    std::swap(mesh.triangles[1][1], mesh.triangles[1][2]);
  return mesh;
}

Vec3 normal_of(const FacetSurface &surface, std::size_t triangle)
{
  const auto corner =
      dem::corners_of(surface, static_cast<std::int32_t>(triangle));
  return (corner[1] - corner[0]).cross(corner[2] - corner[0]).normalized();
}

std::string fault_of(const TriangleMesh &mesh)
{
  try
  {
    dem::wall_surface(mesh, WallSide::outside);
  }
  catch (const std::invalid_argument &error)
  {
    return error.what();
  }
  return "";
}
} // namespace

// The facets of a wall show away from the particles.
TEST(WallMesh, ClosedMeshFacesAwayFromTheParticles)
{
  for (const auto &[side, sign] :
       {std::pair{WallSide::inside, 1.}, {WallSide::outside, -1.}})
  {
    const FacetSurface wall = dem::wall_surface(cube_with_one_turned(), side);
    ASSERT_EQ(wall.triangles.size(), 12u);
    EXPECT_EQ(wall.position.size(), 8u);
    for (std::size_t t = 0; t < 12; ++t)
    {
      const auto corner = dem::corners_of(wall, static_cast<std::int32_t>(t));
      const Vec3 outward =
          (corner[0] + corner[1] + corner[2]) / 3. - Vec3::Constant(0.5);
      EXPECT_GT(sign * normal_of(wall, t).dot(outward), 0.3) << t;
    }
    EXPECT_NO_THROW(dem::FacetTopology topology(wall));
  }
}

TEST(WallMesh, OpenMeshIsJoinedAndTurnedOneWay)
{
  for (const bool turned : {false, true})
  {
    const FacetSurface above =
        dem::wall_surface(floor_of_stl(turned), WallSide::outside);
    EXPECT_EQ(above.position.size(), 4u);
    // Normals of the file point up, to the particles.
    for (std::size_t t = 0; t < 2; ++t)
      EXPECT_EQ(normal_of(above, t), -Vec3::UnitZ());
    const FacetSurface below =
        dem::wall_surface(floor_of_stl(turned), WallSide::inside);
    EXPECT_EQ(normal_of(below, 0), Vec3::UnitZ());
  }
}

TEST(WallMesh, NearPointsOfAnOpenMeshAreOne)
{
  TriangleMesh mesh = floor_of_stl(false);
  mesh.points[3].x() += 1e-6; // of 2.8, the diagonal
  EXPECT_EQ(dem::wall_surface(mesh, WallSide::outside).position.size(), 4u);
  mesh.points[3].x() += 1e-4;
  EXPECT_EQ(dem::wall_surface(mesh, WallSide::outside).position.size(), 5u);
}

TEST(WallMesh, VerticesCannotBeMovedByForces)
{
  const FacetSurface wall =
      dem::wall_surface(floor_of_stl(false), WallSide::outside);
  for (std::size_t v = 0; v < wall.position.size(); ++v)
  {
    EXPECT_TRUE(std::isinf(wall.mass[v]));
    EXPECT_TRUE(wall.velocity[v].isZero(0.));
  }
}

TEST(WallMesh, MeshesThatAreNoSurfaceAreRefused)
{
  EXPECT_EQ(fault_of({}), "mesh has no triangles");
  TriangleMesh fan;
  fan.points = {
      {0., 0., 0.}, {1., 0., 0.}, {0., 1., 0.}, {0., 0., 1.}, {0., -1., 0.}};
  fan.triangles = {{0, 1, 2}, {0, 1, 3}, {0, 1, 4}};
  EXPECT_EQ(fault_of(fan),
            "mesh is no surface: 1 edges belong to more than two triangles, at "
            "most two are allowed");
}

// A sphere is clear of a body that it is outside of, of a container that it is
// inside of, and of an open floor from both sides.
TEST(WallMesh, ClearanceKnowsInsideAndOutside)
{
  dem::WallClearance body, container, floor;
  body.add(dem::wall_surface(cube_with_one_turned(), WallSide::outside));
  container.add(dem::wall_surface(cube_with_one_turned(), WallSide::inside));
  floor.add(dem::wall_surface(floor_of_stl(false), WallSide::outside));
  const Vec3 inside(0.4, 0.5, 0.6), outside(1.2, 0.5, 0.6), far(9., 9., 9.);
  EXPECT_FALSE(body.is_clear(inside, 0.1));
  EXPECT_TRUE(body.is_clear(outside, 0.19));
  EXPECT_FALSE(body.is_clear(outside, 0.21));
  EXPECT_TRUE(body.is_clear(far, 0.1));
  EXPECT_TRUE(container.is_clear(inside, 0.39));
  EXPECT_FALSE(container.is_clear(inside, 0.41));
  EXPECT_FALSE(container.is_clear(outside, 0.1));
  EXPECT_FALSE(container.is_clear(far, 0.1));
  for (const double z : {-0.3, 0.3})
  {
    EXPECT_TRUE(floor.is_clear(Vec3(1., 1., z), 0.29));
    EXPECT_FALSE(floor.is_clear(Vec3(1., 1., z), 0.31));
  }
}
