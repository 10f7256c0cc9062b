#include "dem_scene.h"

#include <dem/engine_boundaries.h>
#include <dem/packing/insertion.h>

#include <gtest/gtest.h>

#include <set>
#include <shape/test_shapes.h>

// A gas of particles in a box: at every look, all that touch by brute force
// must be in the lists of the engine.
namespace
{
constexpr double side = 0.08;

struct Gas
{
  dem::Engine engine;

  Gas(bool is_shaped, std::size_t n, dem::EngineParameters parameters)
      : engine(parameters)
  {
    std::vector<dem::ParticleShape> bodies;
    dem::Random random(11);
    const auto series = std::make_shared<const dem::Coefficients>(
        dem::test::random_particle(20, 8));
    for (std::size_t k = 0; k < n; ++k)
    {
      const double radius = 0.003 + 0.003 * random.uniform();
      bodies.push_back(is_shaped ? dem::make_shape(series, radius)
                                 : dem::make_sphere(radius));
    }
    const auto placements = dem::insert_particles(
        bodies, {dem::Vec3::Zero(), dem::Vec3::Constant(side)}, random);
    const auto some = [&]
    {
      return dem::Vec3(random.uniform() - 0.5, random.uniform() - 0.5,
                       random.uniform() - 0.5);
    };
    for (std::size_t k = 0; k < n; ++k)
    {
      engine.add_particle(bodies[k], placements[k].position,
                          placements[k].orientation);
      engine.particles().velocity(k) = 4. * some();
      engine.particles().spin(k) = 400. * some();
    }
    for (int d = 0; d < 3; ++d)
    {
      dem::add_plane(engine, dem::Vec3::Zero(), dem::Vec3::Unit(d));
      if (d < 2)
        dem::add_plane(engine, dem::Vec3::Constant(side), -dem::Vec3::Unit(d));
    }
    // The lid is a fan of triangles that comes down.
    dem::attach_surface(engine, lid());
  }

  static dem::FacetSurface lid()
  {
    dem::FacetSurface surface =
        support::fixed_surface({{-0.01, -0.01, side},
                                {side + 0.01, -0.01, side},
                                {side + 0.01, side + 0.01, side},
                                {-0.01, side + 0.01, side},
                                {0.5 * side, 0.5 * side, side}},
                               {{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}});
    surface.velocity.assign(5, {0., 0., -1.});
    return surface;
  }

  void advance(double dt, int n_steps)
  {
    for (int step = 0; step < n_steps; ++step)
    {
      for (dem::Vec3 &x : dem::surface(engine).position)
        x.z() -= dt;
      engine.advance(dt);
    }
  }

  double reach(std::size_t i, const dem::Vec3 &direction) const
  {
    const auto &particles = engine.particles();
    const dem::ParticleShape &body = particles.shape[i];
    return body.series
               ? body.scale *
                     dem::radius(*body.series,
                                 particles.rotation(i).transpose() * direction)
               : body.scale;
  }
};

using Pairs = std::set<std::pair<std::size_t, std::size_t>>;

Pairs listed(const dem::ContactBatch &batch)
{
  Pairs pairs;
  for (std::size_t k = 0; k < batch.size(); ++k)
    pairs.emplace(batch.a[k], batch.b[k]);
  return pairs;
}

/// Looks for what the lists have missed; returns the number of contacts.
int check_lists(const Gas &gas)
{
  const dem::Engine &engine = gas.engine;
  const auto x = engine.particles().column(&dem::ParticleState::position);
  const Pairs pairs = listed(engine.pairs());
  const Pairs on_planes = listed(dem::on_planes(engine));
  const std::set<std::int32_t> at_facets(
      dem::facet_boundary(engine).near.particle.begin(),
      dem::facet_boundary(engine).near.particle.end());
  int n = 0;
  for (std::size_t i = 0; i < x.size(); ++i)
  {
    for (std::size_t j = i + 1; j < x.size(); ++j)
    {
      const double distance = (x[j] - x[i]).norm();
      const dem::Vec3 u = (x[j] - x[i]) / distance;
      if (gas.reach(i, u) + gas.reach(j, -u) <= distance)
        continue;
      ++n;
      EXPECT_TRUE(pairs.count({i, j}) || pairs.count({j, i}))
          << i << " and " << j;
    }
    for (std::size_t p = 0; p < dem::planes(engine).size(); ++p)
    {
      const dem::Plane &plane = dem::planes(engine)[p];
      if (gas.reach(i, -plane.normal) <= (x[i] - plane.point).dot(plane.normal))
        continue;
      ++n;
      EXPECT_TRUE(on_planes.count({i, p})) << i << " on plane " << p;
    }
    if (gas.reach(i, dem::Vec3::UnitZ()) <=
        dem::surface(engine).position[0].z() - x[i].z())
      continue;
    ++n;
    EXPECT_TRUE(at_facets.count(static_cast<std::int32_t>(i))) << i;
  }
  return n;
}

void expect_complete(bool is_shaped, double margin)
{
  dem::EngineParameters p = support::bare_parameters();
  p.wall.normal_stiffness = p.surface.normal_stiffness = 1e6;
  p.geometry.usual_skin = margin;
  Gas gas(is_shaped, 120, p);
  int n = 0;
  for (int look = 0; look < 150; ++look)
  {
    gas.advance(4e-6, 20);
    n += check_lists(gas);
  }
  EXPECT_GT(n, 300);
  EXPECT_GT(gas.engine.n_rebuilds(), 3);
  EXPECT_LT(gas.engine.n_rebuilds(), 1500);
}
} // namespace

TEST(Candidates, NoContactOfSpheresIsMissed)
{
  expect_complete(false, 5e-4);
}

TEST(Candidates, NoContactOfShapesIsMissed)
{
  expect_complete(true, 1e-3);
}

namespace
{
/// Rolls and slides in lists of some width.
Gas rough_gas(double usual_margin, double given_margin)
{
  dem::EngineParameters p = support::bare_parameters();
  p.particle.friction = 0.5;
  p.particle.rolling_friction = 0.2;
  p.wall.normal_stiffness = p.surface.normal_stiffness = 1e6;
  p.geometry.usual_skin = usual_margin;
  p.geometry.skin = given_margin;
  Gas gas(false, 120, p);
  gas.advance(4e-6, 1500);
  return gas;
}

void expect_same_motion(const Gas &one, const Gas &other)
{
  for (std::size_t i = 0; i < 120; ++i)
  {
    EXPECT_EQ(one.engine.particles().position(i),
              other.engine.particles().position(i));
    EXPECT_EQ(one.engine.particles().spin(i), other.engine.particles().spin(i));
  }
}
} // namespace

// The lists must not decide: any margin gives the same motion. Contacts are
// visited in one order, so to the last bit.
TEST(Candidates, MarginDoesNotChangeTheMotion)
{
  const Gas narrow = rough_gas(3e-4, 0.), wide = rough_gas(2e-3, 0.);
  EXPECT_GT(narrow.engine.n_rebuilds(), wide.engine.n_rebuilds());
  expect_same_motion(narrow, wide);
}

// The particles move some 0.02 m: lists that see a tenth of a millimetre are
// used up every few steps, and no search finds better ones.
TEST(Candidates, GivenMarginIsKept)
{
  const Gas adapted = rough_gas(1e-3, 0.), narrow = rough_gas(1e-3, 1e-4),
            wide = rough_gas(1e-3, 1e-3);
  EXPECT_GT(narrow.engine.n_rebuilds(), 3 * adapted.engine.n_rebuilds());
  EXPECT_GT(narrow.engine.n_rebuilds(), 8 * wide.engine.n_rebuilds());
  expect_same_motion(narrow, adapted);
  expect_same_motion(narrow, wide);
}
