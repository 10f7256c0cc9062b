#include "dem_scene.h"

#include <dem/engine_boundaries.h>

#include <gtest/gtest.h>

#include <string>

// Spheres of 10 and 6 mm that overlap by 0.3 mm with each other or with a
// wall. Nothing moves, so the overlap over radius is known to round-off.
namespace
{
using dem::Vec3;

constexpr double large = 0.010, small = 0.006, overlap = 3e-4; // [m]
constexpr double still = 1e-12;                                // [s]
constexpr double tiny = 1e-9; // of the motion in a step [-]

dem::Engine make_engine(double stop = 0.5)
{
  dem::EngineParameters parameters = support::bare_parameters();
  parameters.geometry.overlap.stop = stop;
  return dem::Engine(parameters);
}

void add_pair(dem::Engine &engine)
{
  support::add_sphere(engine, large, Vec3::Zero());
  support::add_sphere(engine, small, {large + small - overlap, 0., 0.});
}

/// Below the plane z = 0, a triangle far wider than the sphere.
dem::FacetSurface wide_triangle()
{
  return support::fixed_surface({{-1., -1., 0.}, {1., -1., 0.}, {0., 1., 0.}},
                                {{0, 2, 1}});
}

std::string stop_text(dem::Engine &engine)
{
  try
  {
    engine.advance(still);
  }
  catch (const dem::OverlapStop &stop)
  {
    return stop.what();
  }
  return "";
}

bool has(const std::string &text, const std::string &part)
{
  return text.find(part) != std::string::npos;
}
} // namespace

TEST(OverlapWatch, PairOverSmallerRadius)
{
  dem::Engine engine = make_engine();
  add_pair(engine);
  engine.advance(still);
  EXPECT_NEAR(engine.overlaps().largest, overlap / small, tiny);
}

TEST(OverlapWatch, PlaneOverRadius)
{
  dem::Engine engine = make_engine();
  support::add_sphere(engine, small, {0., 0., small - overlap});
  dem::add_plane(engine, Vec3::Zero(), Vec3::UnitZ());
  engine.advance(still);
  EXPECT_NEAR(engine.overlaps().largest, overlap / small, tiny);
}

TEST(OverlapWatch, DrumOverRadius)
{
  dem::Engine engine = make_engine();
  dem::Drum drum;
  drum.radius = 0.1;
  drum.length = 0.2;
  dem::set_drum(engine, drum);
  support::add_sphere(engine, small, {0., 0., -0.1 + small - overlap});
  engine.advance(still);
  EXPECT_NEAR(engine.overlaps().largest, overlap / small, tiny);
}

TEST(OverlapWatch, FacetOverRadius)
{
  dem::Engine engine = make_engine();
  support::add_sphere(engine, small, {0., 0., small - overlap});
  dem::attach_surface(engine, wide_triangle());
  engine.advance(still);
  EXPECT_NEAR(engine.overlaps().largest, overlap / small, tiny);
}

// A row of the history begins again, the run does not; and what is less deep
// than what is known is found after it.
TEST(OverlapWatch, RecentBeginsAgain)
{
  dem::Engine engine = make_engine();
  add_pair(engine);
  engine.advance(still);
  engine.particles().position(1).x() += 0.5 * overlap;
  engine.advance(still);
  EXPECT_NEAR(engine.overlaps().recent, overlap / small, tiny);
  engine.begin_overlap_interval();
  engine.advance(still);
  EXPECT_NEAR(engine.overlaps().recent, 0.5 * overlap / small, tiny);
  EXPECT_NEAR(engine.overlaps().largest, overlap / small, tiny);
}

TEST(OverlapWatch, StopNamesBothParticles)
{
  dem::Engine engine = make_engine(0.99 * overlap / small);
  add_pair(engine);
  const std::string text = stop_text(engine);
  EXPECT_TRUE(has(text, "particle 0 (11.5 g, radius 10 mm)")) << text;
  EXPECT_TRUE(has(text, "particle 1 (2.49 g, radius 6 mm)")) << text;
  EXPECT_TRUE(has(text, "overlap by 0.3 mm")) << text;
  EXPECT_TRUE(has(text, "0.05 of the smaller radius")) << text;
}

TEST(OverlapWatch, StopNamesTheWall)
{
  dem::Engine engine = make_engine(0.99 * overlap / small);
  support::add_sphere(engine, small, {0., 0., small - overlap});
  dem::attach_surface(engine, wide_triangle());
  EXPECT_TRUE(has(stop_text(engine), "the facets 'surface'"));
}

TEST(OverlapWatch, NoStopBelowTheLimit)
{
  dem::Engine engine = make_engine(1.01 * overlap / small);
  add_pair(engine);
  EXPECT_NO_THROW(engine.advance(still));
}

// Rough packings overlap on purpose.
TEST(OverlapWatch, NoStopWhereParticlesMayEscape)
{
  dem::Engine engine = make_engine(0.99 * overlap / small);
  add_pair(engine);
  engine.allow_escape();
  EXPECT_NO_THROW(engine.advance(still));
}
