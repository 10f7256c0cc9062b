#include "dem_scene.h"

#include <dem/boundary/wall_mesh.h>

#include <gtest/gtest.h>

#include <shape/test_shapes.h>
#include <sstream>

// Rigid walls of any shape, against planes and closed forms.
namespace
{
using dem::Vec3;

constexpr double radius = 0.01;

dem::EngineParameters linear_walls()
{
  dem::EngineParameters p = support::bare_parameters();
  p.wall.normal_stiffness = 2e5;
  p.wall.shear_stiffness = 1.7e5;
  p.surface = p.wall;
  return p;
}

/// A square of the plane z = 0 about the origin in 2 n n triangles, normals up.
dem::TriangleMesh square(double half, int n)
{
  dem::TriangleMesh mesh;
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i)
      mesh.points.emplace_back(half * (2. * i / n - 1.),
                               half * (2. * j / n - 1.), 0.);
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i)
    {
      const std::int32_t k = j * (n + 1) + i;
      mesh.triangles.push_back({k, k + 1, k + n + 2});
      mesh.triangles.push_back({k, k + n + 2, k + n + 1});
    }
  return mesh;
}

void add_floor(dem::Engine &engine, const dem::WallMotion &motion,
               int n_cells = 7)
{
  dem::add_mesh_wall(
      engine, "floor", engine.parameters().wall,
      dem::wall_surface(square(0.1, n_cells), dem::WallSide::outside), motion);
}

double unit_time(const dem::Engine &engine)
{
  return std::sqrt(engine.particles().mass(0) /
                   engine.parameters().wall.normal_stiffness);
}

const dem::MeshWall &floor_of(const dem::Engine &engine)
{
  return dem::mesh_walls(engine)[0];
}
} // namespace

// A ball that hops and slides over the floor and spins: planes and triangles,
// at rest and rising. Both know the overlap to round-off of coordinates of
// 0.1 m, 1e-17 m of overlaps of 1e-4 m.
TEST(MeshWall, TrianglesOfAPlaneActAsThePlane)
{
  for (const double rising : {0., 0.05})
  {
    dem::EngineParameters p = linear_walls();
    p.wall.friction = 0.4;
    p.wall.rolling_friction = 0.05;
    p.wall.normal_damping = p.wall.shear_damping = 0.1;
    p.gravity = {0., 0., -9.81};
    dem::Engine on_plane(p), on_mesh(p);
    for (dem::Engine *engine : {&on_plane, &on_mesh})
    {
      support::add_sphere(*engine, radius, {-0.03, -0.02, radius + 1e-4});
      engine->particles().velocity(0) = {0.4, 0.3, -0.5};
      engine->particles().spin(0) = {10., -20., 30.};
    }
    dem::add_plane(on_plane, Vec3::Zero(), Vec3::UnitZ());
    dem::planes(on_plane)[0].velocity = {0., 0., rising};
    dem::WallMotion motion;
    motion.velocity = {0., 0., rising};
    add_floor(on_mesh, motion);
    const double dt = 0.05 * unit_time(on_mesh);
    double largest_force = 0.;
    for (int step = 0; step < 4000; ++step)
    {
      on_plane.advance(dt);
      on_mesh.advance(dt);
      largest_force =
          std::max(largest_force, dem::planes(on_plane)[0].force.norm());
      ASSERT_NEAR(
          (dem::planes(on_plane)[0].force - floor_of(on_mesh).load().force)
              .norm(),
          0., 1e-6 * largest_force)
          << step;
    }
    EXPECT_GT(largest_force, 1.);
    EXPECT_NEAR(
        (on_plane.particles().position(0) - on_mesh.particles().position(0))
            .norm(),
        0., 1e-10);
    EXPECT_NEAR(
        (on_plane.particles().spin(0) - on_mesh.particles().spin(0)).norm(), 0.,
        1e-6);
    EXPECT_NEAR(on_plane.energy().work_of("planes"),
                on_mesh.energy().work_of("mesh walls"), 1e-8);
  }
}

// A particle with its true surface tumbles on a plane, on an open mesh above
// which it is, and on the top of a closed block that it is outside of. Contact
// points are followed by one Newton step in each time step: 1e-6 of the radius
// after some impacts.
TEST(MeshWall, TrueSurfacesSeeTheSideOfTheParticles)
{
  dem::EngineParameters p = linear_walls();
  p.geometry.geometry = p.geometry.wall_geometry =
      dem::ContactGeometry::surface;
  p.wall.friction = 0.05;
  p.gravity = {0., 0., -9.81};
  const dem::ParticleShape body =
      dem::shape_of(dem::test::random_particle(10, 3));
  dem::TriangleMesh block;
  for (int k = 0; k < 8; ++k)
    block.points.emplace_back(0.1 * (k & 1 ? 1. : -1.),
                              0.1 * (k & 2 ? 1. : -1.), k & 4 ? 0. : -0.05);
  block.triangles = {{0, 1, 3}, {0, 3, 2}, {4, 5, 7}, {4, 7, 6},
                     {0, 1, 5}, {0, 5, 4}, {2, 7, 3}, {2, 6, 7},
                     {0, 6, 2}, {0, 4, 6}, {1, 3, 7}, {1, 7, 5}};
  std::vector<Vec3> ends;
  for (int which = 0; which < 3; ++which)
  {
    dem::Engine engine(p);
    engine.add_particle(body, {-0.02, 0.01, 0.016},
                        dem::Quaternion::Identity());
    engine.particles().velocity(0) = {0.2, 0.1, -0.3};
    engine.particles().spin(0) = {5., -10., 3.};
    if (which == 0)
      dem::add_plane(engine, Vec3::Zero(), Vec3::UnitZ());
    else if (which == 1)
      add_floor(engine, {});
    else
      dem::add_mesh_wall(engine, "block", p.wall,
                         dem::wall_surface(block, dem::WallSide::outside), {});
    support::advance(engine, 0.02 * unit_time(engine), 12000);
    ends.push_back(engine.particles().position(0));
    EXPECT_GT(engine.energy().friction, 0.);
  }
  EXPECT_GT(ends[0].z(), 0.005);
  for (const Vec3 &end : ends)
    EXPECT_NEAR((end - ends[0]).norm(), 0., 1e-5 * radius) << end.transpose();
}

// A free wall and a ball collide without loss: v' = v - 2 m_w/(m_w + m) (v - u)
// of a ball that flies with v at a wall with u, and momentum stays. A mass that
// is wrong by 1 % changes v' by 0.25 % of v - u.
TEST(MeshWall, FreeWallAndBallCollideElastically)
{
  dem::Engine engine(linear_walls());
  support::add_sphere(engine, radius, {0.013, -0.004, radius + 1e-5});
  const double v = -0.2, m = engine.particles().mass(0);
  engine.particles().velocity(0) = {0., 0., v};
  dem::WallMotion motion;
  motion.free = Vec3::UnitZ();
  motion.mass = 3. * m;
  add_floor(engine, motion);
  const double dt = 0.005 * unit_time(engine);
  support::advance(engine, dt, 3000);
  const double u = floor_of(engine).pose().velocity.z(),
               after = engine.particles().velocity(0).z();
  EXPECT_NEAR(after, v - 2. * 0.75 * v, 1e-4 * std::abs(v));
  EXPECT_NEAR(u, 2. * 0.25 * v, 1e-4 * std::abs(v));
  // The wall takes the force at the beginning of each step, as the ball does.
  EXPECT_NEAR(m * after + motion.mass * u, m * v, 1e-9 * m * std::abs(v));
}

// A lid that presses on three balls of one height: each bears a third of its
// weight and force, k d = F / 3 at lid and floor alike.
TEST(MeshWall, LidUnderAForceRestsOnItsBalls)
{
  dem::EngineParameters p = linear_walls();
  p.wall.normal_damping = 0.62;
  dem::Engine engine(p);
  for (const double angle : {0., 2.1, 4.2})
    support::add_sphere(
        engine, radius,
        {0.05 * std::cos(angle), 0.05 * std::sin(angle), radius});
  add_floor(engine, {});
  dem::WallMotion motion;
  motion.free = Vec3::UnitZ();
  motion.mass = 0.05;
  motion.force = {0., 0., -12.};
  dem::TriangleMesh lid = square(0.1, 3);
  for (Vec3 &point : lid.points)
    point.z() = 2. * radius;
  dem::add_mesh_wall(engine, "lid", p.wall,
                     dem::wall_surface(lid, dem::WallSide::inside), motion);
  support::advance(engine, 0.05 * unit_time(engine), 40000);
  const dem::MeshWall &wall = dem::mesh_walls(engine)[1];
  EXPECT_NEAR(wall.load().force.z(), 12., 1e-6);
  EXPECT_NEAR(floor_of(engine).load().force.z(), -12., 1e-6);
  EXPECT_NEAR(wall.pose().shift.z(), -2. * 4. / p.wall.normal_stiffness, 1e-11);
}

// A paddle strikes a ball at rest: a heavy wall that turns throws it with twice
// its speed at the point of contact, and the moment on it is lever times force.
TEST(MeshWall, PaddleThrowsABall)
{
  dem::Engine engine(linear_walls());
  const double lever = 0.05, rate = 3.;
  support::add_sphere(engine, radius, {lever, 0., radius + 1e-6});
  dem::WallMotion motion;
  motion.axis = -Vec3::UnitY(); // the far side comes up
  motion.spin = rate;
  add_floor(engine, motion);
  const double dt = 0.005 * unit_time(engine);
  double worst = 0., force = 0.;
  for (int step = 0; step < 1500; ++step)
  {
    engine.advance(dt);
    const dem::WallLoad load = floor_of(engine).load();
    force = std::max(force, -load.force.z());
    worst = std::max(worst, std::abs(load.moment.y() + lever * load.force.z()));
  }
  EXPECT_NEAR(engine.particles().velocity(0).z(), 2. * rate * lever,
              2e-3 * rate * lever);
  EXPECT_LT(worst, 2e-3 * lever * force);
}

// A driven wall that turns, with particles on it, continues from a checkpoint
// with the same bits.
TEST(MeshWall, RestartsBitForBit)
{
  dem::EngineParameters p = linear_walls();
  p.wall.friction = 0.5;
  p.gravity = {0., 0., -9.81};
  dem::Engine unbroken(p);
  for (const double x : {-0.03, 0.01, 0.04})
    support::add_sphere(unbroken, radius, {x, 0.3 * x, radius});
  dem::WallMotion motion;
  motion.axis = Vec3::UnitX();
  motion.inertia = 1e-4;
  motion.torque = 1e-3;
  motion.free = Vec3::UnitZ();
  motion.mass = 0.2;
  motion.force = {0., 0., 2.};
  motion.table_time = {0., 1.};
  motion.table_shift = {Vec3::Zero(), Vec3(0.1, 0., 0.)};
  add_floor(unbroken, motion);
  const double dt = 0.05 * unit_time(unbroken);
  support::advance(unbroken, dt, 200);
  std::stringstream state;
  unbroken.save(state, {});
  dem::Engine restarted(p);
  restarted.restore(state, {});
  support::advance(unbroken, dt, 300);
  support::advance(restarted, dt, 300);
  std::ostringstream a, b;
  unbroken.save(a, {});
  restarted.save(b, {});
  EXPECT_EQ(a.str(), b.str());
  EXPECT_NE(floor_of(unbroken).pose().angle, 0.);
}
