#include "dem_scene.h"

#include <dem/engine_boundaries.h>
#include <dem/packing/rough_packing.h>

#include <gtest/gtest.h>

#include <algorithm>

namespace
{
using namespace dem;

dem::EngineParameters soft_walls()
{
  dem::EngineParameters p = support::bare_parameters();
  p.wall.normal_stiffness = 1e6; // [N/m]
  return p;
}

/// Spheres of two sizes in a box that they fill to six tenths.
struct Packing
{
  Packing()
  {
    for (int i = 0; i < 250; ++i)
      bodies.push_back(dem::make_sphere(i < 125 ? 0.01 : 0.005));
    double volume = 0.;
    for (const dem::ParticleShape &body : bodies)
      volume += body.volume;
    height = volume / (0.6 * room.section());
    for (int d = 0; d < 2; ++d)
      for (const double sign : {-1., 1.})
        dem::add_plane(engine, sign * 0.05 * dem::Vec3::Unit(d),
                       -sign * dem::Vec3::Unit(d));
    dem::add_plane(engine, room.floor, dem::Vec3::UnitZ());
  }

  void fill()
  {
    const auto placements = dense_packing(bodies, room, height, 0.2);
    for (std::size_t i = 0; i < bodies.size(); ++i)
      engine.add_particle(bodies[i], placements[i].position,
                          placements[i].orientation);
  }

  double deepest() const
  {
    double deepest = 0.;
    for (std::size_t k = 0; k < engine.pairs().size(); ++k)
      if (engine.pairs().is_touching(k))
        deepest = std::max(deepest, engine.pairs().overlap[k]);
    return deepest;
  }

  double highest() const
  {
    double highest = 0.;
    for (std::size_t i = 0; i < bodies.size(); ++i)
      highest = std::max(highest, engine.particles().position(i).z() +
                                      engine.particles().radius(i));
    return highest;
  }

  dem::Room room{dem::Vec3(0., 0., 0.1), 0.1, 0.1, false};
  double height = 0.;
  std::vector<dem::ParticleShape> bodies;
  dem::Engine engine{soft_walls()};
};

TEST(RoughPacking, LetsGoOfTheOverlapsOfADensePacking)
{
  Packing packing;
  packing.fill();
  EXPECT_LT(packing.highest(),
            packing.room.floor.z() + packing.height + 0.01); // largest radius
  packing.engine.allow_escape();
  packing.engine.advance_deferred(1e-15);
  packing.engine.synchronize();
  const double before = packing.deepest();
  EXPECT_GT(before, 0.005); // of a radius of the smaller ones
  relax(packing.engine, 1e-4);
  EXPECT_LT(packing.deepest(), 0.15 * before);
  // They have gone up, and stayed together.
  EXPECT_LT(packing.highest(), packing.room.floor.z() + 1.5 * packing.height);
}

TEST(RoughPacking, IsPressedUntilItCarriesTheLoad)
{
  Packing packing;
  packing.fill();
  relax(packing.engine, 1e-4);
  const std::size_t plane =
      dem::add_plane(packing.engine, dem::Vec3::Zero(), -dem::Vec3::UnitZ());
  dem::deactivate_plane(packing.engine, plane);
  constexpr double load = 500.; // [N]
  press(packing.engine, plane, load, 1e-5);
  EXPECT_GE(dem::planes(packing.engine)[plane].force.z(), load);
  EXPECT_LT(dem::planes(packing.engine)[plane].force.z(), 3. * load);
  EXPECT_EQ(dem::planes(packing.engine)[plane].velocity, dem::Vec3::Zero());
  EXPECT_EQ(packing.engine.energy().kinetic, 0.);
}
} // namespace
