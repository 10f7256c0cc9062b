// Periodic cells: forces, momentum, energy and stress across their faces.
#include <dem/control/box_servo.h>
#include <dem/engine_boundaries.h>
#include <dem/measure/assembly.h>
#include <dem/measure/region_stress.h>
#include <dem/random.h>

#include <gtest/gtest.h>

#include <dem_scene.h>
#include <shape/test_shapes.h>
#include <sstream>

namespace
{
using dem::Vec3;
constexpr double radius = 5e-3;

Vec3 total_force(const dem::Engine &engine)
{
  Vec3 sum = Vec3::Zero();
  for (const dem::ParticleLoad &load : engine.particles().load)
    sum += load.force;
  return sum;
}

Vec3 momentum(const dem::Engine &engine)
{
  Vec3 sum = Vec3::Zero();
  for (std::size_t i = 0; i < engine.particles().size(); ++i)
    sum += engine.particles().mass(i) * engine.particles().velocity(i);
  return sum;
}

/// n^3 spheres of two sizes on a lattice that fills the cell, moving at random.
void add_gas(dem::Engine &engine, int n, const Vec3 &lower, const Vec3 &length,
             double speed)
{
  std::mt19937_64 random(7);
  std::normal_distribution<double> normal;
  for (int i = 0; i < n * n * n; ++i)
  {
    const Vec3 site(i % n, i / n % n, i / n / n);
    support::add_sphere(
        engine, i % 3 == 0 ? 0.7 * radius : radius,
        lower + length.cwiseProduct((site + Vec3::Constant(0.5)) / n));
    engine.particles().velocity(std::size_t(i)) =
        speed * Vec3(normal(random), normal(random), normal(random));
  }
}

/// Spheres on each other, with friction and damping.
dem::EngineParameters aggregate()
{
  dem::EngineParameters p = support::bare_parameters();
  p.particle.shear_modulus = 5e7;
  p.particle.friction = 0.4;
  p.particle.rolling_friction = 0.1;
  p.particle.normal_damping = p.particle.shear_damping = 0.3;
  return p;
}

double booked(const dem::EngineEnergy &e)
{
  return e.kinetic + e.elastic + e.friction + e.rolling + e.damping +
         e.non_conservative_work - e.cell_work - e.work_of("planes");
}

/// Stress of the contacts, virial over volume [Pa].
dem::Mat3 contact_stress(const dem::Engine &engine)
{
  return dem::contact_virial(engine.particles(),
                             dem::contact_network_of(engine)) /
         engine.cell().length.prod();
}
} // namespace

TEST(PeriodicCell, PairAcrossAFaceIsThatSideBySide)
{
  const Vec3 length(0.1, 0.12, 0.14);
  for (int axis = 0; axis < 3; ++axis)
  {
    dem::Engine apart(support::bare_parameters()),
        beside(support::bare_parameters());
    apart.set_periodic_cell(Vec3::Zero(), length);
    const Vec3 half = 0.4999 * 2. * radius * Vec3::Unit(axis);
    support::add_sphere(beside, radius, -half);
    support::add_sphere(beside, radius, half);
    const Vec3 face = 0.5 * length[axis] * Vec3::Unit(axis);
    support::add_sphere(apart, radius, face - half);
    support::add_sphere(apart, radius, -face + half);
    beside.evaluate(1e-7);
    apart.evaluate(1e-7);
    const Vec3 expected = beside.particles().load[0].force;
    EXPECT_GT(expected.norm(), 0.1);
    EXPECT_LT((apart.particles().load[0].force - expected).norm(),
              1e-9 * expected.norm());
    EXPECT_LT(total_force(apart).norm(), 1e-12 * expected.norm());
    // All of the force goes through the face.
    EXPECT_NEAR(apart.cell().force[axis], -expected.norm(),
                1e-9 * expected.norm());
    const double area = length[(axis + 1) % 3] * length[(axis + 2) % 3];
    EXPECT_NEAR(apart.cell().stress(axis, area), expected.norm() / area,
                1e-9 * expected.norm() / area);
  }
}

// Undamped spheres that fly through the faces many times.
TEST(PeriodicCell, MomentumAndEnergyStay)
{
  dem::EngineParameters p = support::bare_parameters();
  p.particle.shear_modulus = 5e7;
  dem::Engine engine(p);
  const Vec3 length = Vec3::Constant(0.075);
  engine.set_periodic_cell(0.5 * length, length);
  add_gas(engine, 6, Vec3::Zero(), length, 1.);
  const Vec3 before = momentum(engine);
  const double kinetic = engine.energy().kinetic;
  double farthest = 0.;
  for (int k = 0; k < 20000; ++k)
    engine.advance(5e-6);
  for (std::size_t i = 0; i < engine.particles().size(); ++i)
    farthest = std::max(
        farthest,
        (engine.particles().position(i) - 0.5 * length).cwiseAbs().maxCoeff());
  EXPECT_GT(farthest, 0.5 * length.x()); // some are outside of the cell
  EXPECT_GT(engine.n_rebuilds(), 10);
  EXPECT_LT((momentum(engine) - before).norm(), 1e-10 * before.norm());
  // The books take displacements along the normals: second order in the step.
  EXPECT_NEAR(booked(engine.energy()), kinetic, 5e-5 * kinetic);
  EXPECT_LT(std::abs(engine.energy().non_conservative_work), 5e-3 * kinetic);
}

// The lists find all contacts that a search over all pairs and images finds.
TEST(PeriodicCell, ListsMissNoContact)
{
  dem::EngineParameters p = support::bare_parameters();
  p.particle.shear_modulus = 5e7;
  dem::Engine engine(p);
  const Vec3 length(0.075, 0.08, 0.085);
  engine.set_periodic_cell(Vec3::Zero(), length);
  add_gas(engine, 6, -0.5 * length, length, 2.);
  engine.set_cell_rate(Vec3(-0.02, 0.01, -0.03));
  for (int k = 0; k < 4000; ++k)
  {
    engine.advance(5e-6);
    if (k % 50 != 0)
      continue;
    int n_brute = 0, n_listed = 0;
    const dem::ParticleSystem &particles = engine.particles();
    for (std::size_t i = 0; i < particles.size(); ++i)
      for (std::size_t j = 0; j < i; ++j)
      {
        Vec3 branch = particles.position(i) - particles.position(j);
        for (int d = 0; d < 3; ++d)
        {
          const double size = engine.cell().length[d];
          branch[d] -= size * std::round(branch[d] / size);
        }
        n_brute += branch.norm() < particles.radius(i) + particles.radius(j);
      }
    for (std::size_t k2 = 0; k2 < engine.pairs().size(); ++k2)
      n_listed += engine.pairs().is_touching(k2);
    ASSERT_EQ(n_listed, n_brute) << k;
  }
}

// Isotropic compression of a loose aggregate to a stress: the servo holds the
// stress on the faces, the contacts bear it, all energy is booked.
TEST(PeriodicCell, IsotropicCompressionBearsTheStressOfTheServo)
{
  const double pressure = 2e4;
  dem::EngineParameters p = aggregate();
  p.particle.friction = 0.1;
  p.local_damping = 0.2;
  dem::Engine engine(p);
  const Vec3 length = Vec3::Constant(0.085);
  const dem::SpecimenWalls walls =
      dem::add_periodic_cell(engine, -0.5 * length, 0.5 * length);
  add_gas(engine, 7, -0.5 * length, length, 0.1);
  const double before = engine.energy().kinetic;
  dem::ServoParameters servo_parameters;
  servo_parameters.response_time = 1e-3;
  dem::BoxServo servo(walls, servo_parameters);
  for (int d = 0; d < 3; ++d)
    servo.follow(d, pressure);
  for (int k = 0; k < 60000; ++k)
  {
    servo.update(engine, 5e-6);
    engine.advance(5e-6);
  }
  double solids = 0.;
  for (const dem::ParticleShape &body : engine.particles().shape)
    solids += body.volume;
  const double fraction = solids / engine.cell().length.prod();
  EXPECT_GT(fraction, 0.55);
  EXPECT_LT(fraction, 0.72);
  const Vec3 stress = dem::box_stress(engine, walls);
  const dem::Mat3 borne = contact_stress(engine);
  for (int d = 0; d < 3; ++d)
  {
    EXPECT_NEAR(stress[d], pressure, 0.01 * pressure);
    EXPECT_NEAR(borne(d, d), stress[d], 0.005 * pressure);
  }
  EXPECT_LT(dem::unbalanced_force_ratio(engine), 0.01);
  const dem::EngineEnergy energy = engine.energy();
  EXPECT_NEAR(booked(energy), before, 1e-3 * energy.cell_work);
  EXPECT_GT(energy.cell_work, 0.);
}

// Periodic across, a floor and a lid along z: the weight is on the floor.
TEST(PeriodicCell, TwoAxesAndAFloor)
{
  dem::EngineParameters p = aggregate();
  p.wall = dem::WallMaterial{};
  p.wall.normal_stiffness = 1e6;
  p.wall.shear_stiffness = 0.85e6;
  p.gravity = {0., 0., -9.81};
  dem::Engine engine(p);
  const Vec3 length(0.08, 0.08, 0.09);
  engine.set_periodic_cell(0.5 * length, {length.x(), length.y(), 0.});
  dem::add_plane(engine, Vec3::Zero(), Vec3::UnitZ());
  add_gas(engine, 6, Vec3::Zero(), length, 0.1);
  double weight = 0.;
  for (std::size_t i = 0; i < engine.particles().size(); ++i)
    weight += 9.81 * engine.particles().mass(i);
  constexpr int n_steps = 60000, n_at_rest = 20000;
  constexpr double time_step = 1e-5;
  for (int k = 0; k < n_steps; ++k)
  {
    if (k == n_steps - n_at_rest) // some still roll to and fro
      dem::planes(engine)[0].impulse = Vec3::Zero();
    engine.advance(time_step);
  }
  EXPECT_NEAR(-dem::planes(engine)[0].impulse.z() / (n_at_rest * time_step),
              weight, 0.01 * weight);
  EXPECT_GT(engine.cell().stress(0, length.y() * length.z()),
            0.); // they lean on each other
}

// Local radii across the faces: momentum and the books.
TEST(PeriodicCell, ShapesMeetAcrossTheFaces)
{
  dem::EngineParameters p = aggregate();
  p.geometry.geometry = dem::ContactGeometry::radial;
  dem::Engine engine(p);
  const Vec3 length = Vec3::Constant(0.1);
  engine.set_periodic_cell(Vec3::Zero(), length);
  const auto series = std::make_shared<const dem::Coefficients>(
      dem::test::random_particle(8, 3));
  std::mt19937_64 random(5);
  std::normal_distribution<double> normal;
  for (int i = 0; i < 64; ++i)
  {
    const Vec3 site(i % 4, i / 4 % 4, i / 16);
    engine.add_particle(
        dem::make_shape(series, 0.011),
        -0.5 * length + length.cwiseProduct((site + Vec3::Constant(0.5)) / 4),
        dem::Quaternion(normal(random), normal(random), normal(random),
                        normal(random))
            .normalized());
    engine.particles().velocity(std::size_t(i)) =
        Vec3(normal(random), normal(random), normal(random));
  }
  const Vec3 before = momentum(engine);
  const double kinetic = engine.energy().kinetic;
  engine.set_cell_rate(Vec3::Constant(-0.1));
  for (int k = 0; k < 10000; ++k)
    engine.advance(5e-6);
  EXPECT_LT(engine.cell().force.x(), 0.);
  EXPECT_LT((momentum(engine) - before).norm(), 1e-9 * before.norm());
  // Radii that turn with the particle: the books are of second order, too.
  EXPECT_NEAR(booked(engine.energy()), kinetic, 1e-3 * kinetic);
}

TEST(PeriodicCell, IsRestartedBitForBit)
{
  const auto scene = []
  {
    dem::Engine engine(aggregate());
    engine.set_periodic_cell(Vec3::Zero(), Vec3::Constant(0.075));
    return engine;
  };
  dem::Engine one = scene();
  add_gas(one, 6, Vec3::Constant(-0.0375), Vec3::Constant(0.075), 1.);
  one.set_cell_rate(Vec3::Constant(-0.05));
  support::advance(one, 5e-6, 700);
  std::stringstream file;
  one.save(file, {});
  dem::Engine other = scene();
  other.restore(file, {});
  support::advance(one, 5e-6, 700);
  support::advance(other, 5e-6, 700);
  for (std::size_t i = 0; i < one.particles().size(); ++i)
    EXPECT_EQ(one.particles().position(i), other.particles().position(i));
  EXPECT_EQ(one.energy().cell_work, other.energy().cell_work);
}

// Two bodies that meet across a face, once as images and once side by side:
// their common normals, forces and moments are the same ones.
TEST(PeriodicCell, TrueSurfacesAcrossAFaceAreThoseSideBySide)
{
  dem::EngineParameters p = aggregate();
  p.geometry.geometry = p.geometry.wall_geometry =
      dem::ContactGeometry::surface;
  const auto series = std::make_shared<const dem::Coefficients>(
      dem::test::random_particle(8, 3));
  const dem::ParticleShape shape = dem::make_shape(series, 0.011);
  const dem::Quaternion turned(
      Eigen::AngleAxisd(0.7, Vec3(1., 2., -1.).normalized()));
  const Vec3 length(0.1, 0.11, 0.12);
  for (int axis = 0; axis < 3; ++axis)
  {
    dem::Engine apart(p), beside(p);
    apart.set_periodic_cell(Vec3::Zero(), length);
    const Vec3 along = Vec3::Unit(axis);
    const Vec3 half = 0.0117 * along, face = 0.5 * length[axis] * along;
    beside.add_particle(shape, -half, dem::Quaternion::Identity());
    beside.add_particle(shape, half, turned);
    apart.add_particle(shape, face - half, dem::Quaternion::Identity());
    apart.add_particle(shape, half - face, turned);
    for (dem::Engine *engine : {&beside, &apart})
      for (std::size_t i = 0; i < 2; ++i)
      {
        engine->particles().velocity(i) = (i == 0 ? 1. : -1.) * along;
        engine->particles().spin(i) = Vec3(3., -2., 1.);
      }
    double largest = 0.;
    for (int k = 0; k < 3000; ++k)
    {
      beside.advance(1e-6);
      apart.advance(1e-6);
      const dem::ParticleLoad &one = beside.particles().load[0],
                              &other = apart.particles().load[0];
      largest = std::max(largest, one.force.norm());
      ASSERT_LT((one.force - other.force).norm(), 1e-6 * largest + 1e-9) << k;
      ASSERT_LT((one.moment - other.moment).norm(), 1e-8 * largest + 1e-11)
          << k;
    }
    EXPECT_GT(largest, 10.) << axis;
  }
}

// A packing of true surfaces under the servo: the stress on the faces is that
// of the contacts, all energy is booked.
TEST(PeriodicCell, TrueSurfacesBearTheStressOfTheServo)
{
  const double pressure = 5e4;
  dem::EngineParameters p = aggregate();
  p.particle.friction = 0.1;
  p.local_damping = 0.3;
  p.geometry.geometry = p.geometry.wall_geometry =
      dem::ContactGeometry::surface;
  dem::Engine engine(p);
  const Vec3 length = Vec3::Constant(0.1);
  const dem::SpecimenWalls walls =
      dem::add_periodic_cell(engine, -0.5 * length, 0.5 * length);
  const auto series = std::make_shared<const dem::Coefficients>(
      dem::test::random_particle(8, 3));
  std::mt19937_64 random(5);
  std::normal_distribution<double> normal;
  for (int i = 0; i < 64; ++i)
  {
    const Vec3 site(i % 4, i / 4 % 4, i / 16);
    engine.add_particle(
        dem::make_shape(series, 0.0105),
        -0.5 * length + length.cwiseProduct((site + Vec3::Constant(0.5)) / 4),
        dem::Quaternion(normal(random), normal(random), normal(random),
                        normal(random))
            .normalized());
  }
  dem::ServoParameters servo_parameters;
  servo_parameters.response_time = 1e-3;
  dem::BoxServo servo(walls, servo_parameters);
  for (int d = 0; d < 3; ++d)
    servo.follow(d, pressure);
  for (int k = 0; k < 30000; ++k)
  {
    servo.update(engine, 4e-6);
    engine.advance(4e-6);
  }
  const Vec3 stress = dem::box_stress(engine, walls);
  const dem::Mat3 borne = contact_stress(engine);
  for (int d = 0; d < 3; ++d)
  {
    EXPECT_NEAR(stress[d], pressure, 0.01 * pressure);
    EXPECT_NEAR(borne(d, d), stress[d], 0.005 * pressure);
  }
  const dem::EngineEnergy energy = engine.energy();
  EXPECT_NEAR(booked(energy), 0., 2e-3 * energy.cell_work);
  EXPECT_GT(energy.cell_work, 0.);
}

TEST(PeriodicCell, ShortCellsAreRefused)
{
  dem::Engine engine(support::bare_parameters());
  engine.set_periodic_cell(Vec3::Zero(), Vec3::Constant(3.9 * radius));
  support::add_sphere(engine, radius, Vec3::Zero());
  EXPECT_THROW(engine.advance(1e-6), std::runtime_error);
  EXPECT_THROW(engine.set_periodic_cell(Vec3::Zero(), {-1., 0., 0.}),
               std::invalid_argument);
}
