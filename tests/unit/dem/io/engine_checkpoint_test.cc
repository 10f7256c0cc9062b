#include "dem_scene.h"

#include <dem/control/box_servo.h>
#include <dem/engine_boundaries.h>
#include <dem/packing/insertion.h>

#include <gtest/gtest.h>

#include <cstring>
#include <omp.h>
#include <shape/test_shapes.h>
#include <sstream>

// A box of breakable particles between a piston and a lid of facets,
// servo-controlled: saved half way, it goes on to the last bit as if it had not
// been.
namespace
{
constexpr double side = 0.045, time_step = 2e-6;
constexpr int n_steps = 700;

using Library = std::vector<std::shared_ptr<const dem::Coefficients>>;

Library library()
{
  static const Library shapes = {std::make_shared<const dem::Coefficients>(
                                     dem::test::random_particle(20, 3)),
                                 std::make_shared<const dem::Coefficients>(
                                     dem::test::random_particle(20, 4))};
  return shapes;
}

dem::EngineParameters parameters(dem::ContactGeometry geometry)
{
  dem::EngineParameters p; // the article's, walls softer
  p.geometry.geometry = geometry;
  if (geometry == dem::ContactGeometry::surface)
    p.geometry.wall_geometry = geometry;
  p.wall.normal_stiffness = p.surface.normal_stiffness = 1e7;
  p.wall.shear_stiffness = p.surface.shear_stiffness = 0.85e7;
  p.breakage.fracture_energy = 10.; // many events
  p.gravity = {0., 0., -9.81};
  p.local_damping = 0.1;
  return p;
}

struct Scene
{
  dem::Engine engine;
  dem::BoxPlanes box{};
  dem::BoxServo servo{{}, {}};

  explicit Scene(dem::ContactGeometry geometry = dem::ContactGeometry::radial)
      : engine(parameters(geometry))
  {
    box = dem::add_box(engine, dem::Vec3::Zero(), dem::Vec3::Constant(side));
    servo = dem::BoxServo(box, {});
    for (int d = 0; d < 2; ++d)
      servo.follow(d, 2e5);
    dem::deactivate_plane(engine, box[2][1]);
  }

  /// Particles and lid; a scene to be restored has none yet.
  void fill()
  {
    std::vector<dem::ParticleShape> bodies;
    for (std::size_t k = 0; k < 40; ++k)
      bodies.push_back(k % 3 == 2 ? dem::make_sphere(0.004)
                                  : dem::make_shape(library()[k % 2],
                                                    0.004 + 2e-5 * double(k)));
    dem::Random random(2);
    const auto placements = dem::insert_particles(
        bodies, {dem::Vec3::Zero(), dem::Vec3(side, side, side)}, random);
    for (std::size_t k = 0; k < bodies.size(); ++k)
    {
      engine.add_particle(bodies[k], placements[k].position,
                          placements[k].orientation);
      engine.particles().velocity(k) =
          2. * (dem::Vec3::Constant(0.5 * side) - placements[k].position) /
          0.01;
    }
    dem::FacetSurface lid =
        support::fixed_surface({{-0.01, -0.01, side},
                                {side + 0.01, -0.01, side},
                                {side + 0.01, side + 0.01, side},
                                {-0.01, side + 0.01, side},
                                {0.5 * side, 0.5 * side, side}},
                               {{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}});
    lid.velocity.assign(5, {0., 0., -3.});
    dem::attach_surface(engine, lid);
    dem::FacetSurface piston =
        support::fixed_surface({{-0.01, -0.01, 0.},
                                {2. * side + 0.01, -0.01, 0.},
                                {-0.01, 2. * side + 0.01, 0.}},
                               {{2, 1, 0}});
    piston.velocity.assign(3, {0., 0., 6.});
    dem::WallMaterial law = engine.parameters().surface;
    law.friction = 0.5;
    dem::add_surface(engine, "piston", law, piston);
  }

  void advance(int n)
  {
    for (int step = 0; step < n; ++step)
    {
      servo.update(engine, time_step);
      for (dem::FacetBoundary &facets : dem::surfaces(engine))
        for (std::size_t v = 0; v < facets.surface.position.size(); ++v)
          facets.surface.position[v] += time_step * facets.surface.velocity[v];
      engine.advance(time_step);
    }
  }

  std::string saved() const
  {
    std::ostringstream out(std::ios::binary);
    engine.save(out, library());
    servo.save(out);
    return out.str();
  }
};

void expect_same(const dem::ContactBatch &a, const dem::ContactBatch &b)
{
  ASSERT_EQ(a.size(), b.size());
  int column = 0;
  dem::ContactBatch::visit(
      a.layout,
      [&column](bool, const auto &one, const auto &two)
      {
        ASSERT_EQ(one.size(), two.size()) << "column " << column;
        const std::size_t n_bytes = one.size() * sizeof(one[0]);
        if (n_bytes > 0) // memcmp takes no null pointer
        {
          EXPECT_EQ(std::memcmp(one.data(), two.data(), n_bytes), 0)
              << "column " << column;
        }
        ++column;
      },
      a, b);
}

void expect_same(const Scene &one, const Scene &two)
{
  const dem::ParticleSystem &a = one.engine.particles(),
                            &b = two.engine.particles();
  EXPECT_EQ(a.id, b.id);
  EXPECT_EQ(std::memcmp(a.state.data(), b.state.data(),
                        a.size() * sizeof(dem::ParticleState)),
            0);
  for (std::size_t i = 0; i < a.size(); ++i)
  {
    EXPECT_EQ(a.load[i].force, b.load[i].force);
    EXPECT_EQ(a.load[i].moment, b.load[i].moment);
  }
  for (std::size_t i = 0; i < a.size(); ++i)
    EXPECT_EQ(dem::scaled_coefficients(a.shape[i]),
              dem::scaled_coefficients(b.shape[i]));
  expect_same(one.engine.pairs(), two.engine.pairs());
  expect_same(dem::on_planes(one.engine), dem::on_planes(two.engine));
  ASSERT_EQ(dem::surfaces(one.engine).size(), dem::surfaces(two.engine).size());
  for (std::size_t s = 0; s < dem::surfaces(one.engine).size(); ++s)
  {
    const dem::FacetBoundary &facets = dem::facet_boundary(one.engine, s),
                             &others = dem::facet_boundary(two.engine, s);
    EXPECT_EQ(facets.label, others.label);
    EXPECT_EQ(facets.material.friction, others.material.friction);
    expect_same(facets.batch, others.batch);
    EXPECT_EQ(facets.surface.load, others.surface.load);
    EXPECT_EQ(facets.impulse, others.impulse);
    EXPECT_EQ(facets.work(), others.work());
  }
  for (std::size_t p = 0; p < dem::planes(one.engine).size(); ++p)
  {
    EXPECT_EQ(dem::planes(one.engine)[p].point,
              dem::planes(two.engine)[p].point);
    EXPECT_EQ(dem::planes(one.engine)[p].work, dem::planes(two.engine)[p].work);
  }
  const dem::EngineEnergy e = one.engine.energy(), f = two.engine.energy();
  EXPECT_EQ(e.kinetic, f.kinetic);
  EXPECT_EQ(e.elastic, f.elastic);
  EXPECT_EQ(e.friction, f.friction);
  EXPECT_EQ(e.rolling, f.rolling);
  EXPECT_EQ(e.damping, f.damping);
  EXPECT_EQ(e.breakage, f.breakage);
  EXPECT_EQ(e.non_conservative_work, f.non_conservative_work);
  EXPECT_EQ(e.work_of("planes"), f.work_of("planes"));
  EXPECT_EQ(e.work_of("facets"), f.work_of("facets"));
  EXPECT_EQ(e.gravity_work, f.gravity_work);
  EXPECT_EQ(one.engine.time(), two.engine.time());
  EXPECT_EQ(one.engine.n_events(), two.engine.n_events());
  EXPECT_EQ(one.engine.n_rebuilds(), two.engine.n_rebuilds());
}
} // namespace

class EngineCheckpointOf : public testing::TestWithParam<dem::ContactGeometry>
{
};

INSTANTIATE_TEST_SUITE_P(Geometries, EngineCheckpointOf,
                         testing::Values(dem::ContactGeometry::radial,
                                         dem::ContactGeometry::surface));

TEST_P(EngineCheckpointOf, ContinuesBitForBit)
{
  Scene unbroken(GetParam());
  unbroken.fill();
  unbroken.advance(n_steps);
  const std::string state = unbroken.saved();
  const std::int64_t n_before = unbroken.engine.n_events();
  // Breakage has made shapes of their own before and makes more after.
  EXPECT_GT(n_before, 0);
  for (const dem::FacetBoundary &facets : dem::surfaces(unbroken.engine))
    EXPECT_FALSE(facets.near.particle.empty()) << facets.label;

  Scene resumed(GetParam());
  std::istringstream in(state, std::ios::binary);
  resumed.engine.restore(in, library());
  resumed.servo.restore(in);
  expect_same(unbroken, resumed);
  unbroken.advance(n_steps);
  resumed.advance(n_steps);
  expect_same(unbroken, resumed);
  EXPECT_GT(unbroken.engine.n_events(), n_before);
}

// A run of many checkpoints would keep the shape before each breakage event.
TEST(EngineCheckpoint, SavingASceneKeepsNoFormerShape)
{
  auto series = std::make_shared<const dem::Coefficients>(*library().front());
  const std::weak_ptr<const dem::Coefficients> former = series;
  dem::Engine engine(parameters(dem::ContactGeometry::surface));
  engine.add_particle(dem::make_shape(series, 0.01), dem::Vec3::Zero(),
                      dem::Quaternion::Identity());
  series.reset();
  std::ostringstream out(std::ios::binary);
  engine.save(out, {}, dem::StateExtent::scene);
  EXPECT_FALSE(former.expired());
  engine.particles().shape[0].series =
      std::make_shared<const dem::Coefficients>(*library().back());
  engine.save(out, {}, dem::StateExtent::scene);
  EXPECT_TRUE(former.expired());
}

// What was set since construction comes back too.
TEST(EngineCheckpoint, SettingsComeBack)
{
  Scene scene;
  scene.fill();
  scene.engine.set_friction(0.123);
  scene.engine.set_local_damping(0.67);
  Scene resumed;
  std::istringstream in(scene.saved(), std::ios::binary);
  resumed.engine.restore(in, library());
  EXPECT_EQ(resumed.engine.parameters().particle.friction, 0.123);
  EXPECT_EQ(resumed.engine.parameters().local_damping, 0.67);
}

TEST(EngineCheckpoint, CutFileIsRefused)
{
  Scene scene;
  scene.fill();
  scene.advance(10);
  const std::string state = scene.saved();
  for (const double share : {0., 0.3, 0.9})
  {
    Scene resumed;
    std::istringstream in(
        state.substr(0, static_cast<std::size_t>(share * double(state.size()))),
        std::ios::binary);
    EXPECT_THROW(
        {
          resumed.engine.restore(in, library());
          resumed.servo.restore(in);
        },
        std::runtime_error)
        << share;
  }
}

// Every sum over contacts has one order, whatever the threads. Few steps: on
// a busy machine two threads wait for each other.
TEST_P(EngineCheckpointOf, TwoThreadsGiveTheSameBits)
{
  const int before = omp_get_max_threads();
  omp_set_num_threads(1);
  Scene start(GetParam());
  start.fill();
  start.advance(n_steps);
  const std::string state = start.saved();
  Scene scenes[2] = {Scene(GetParam()), Scene(GetParam())};
  for (int n_threads : {1, 2})
  {
    omp_set_num_threads(n_threads);
    Scene &scene = scenes[n_threads - 1];
    std::istringstream in(state, std::ios::binary);
    scene.engine.restore(in, library());
    scene.servo.restore(in);
    scene.advance(60);
  }
  omp_set_num_threads(before);
  expect_same(scenes[0], scenes[1]);
  EXPECT_GT(scenes[0].engine.n_events(), start.engine.n_events());
}
