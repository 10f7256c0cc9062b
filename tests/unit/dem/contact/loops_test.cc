#include "dem_scene.h"

#include <dem/engine_boundaries.h>
#include <dem/instruction_set.h>
#include <dem/packing/insertion.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <limits>
#include <map>
#include <shape/test_shapes.h>
#include <sstream>
#include <stdexcept>
#include <vector>

// The loops over contacts and particles: one set of digits for all instruction
// sets, with a look at every step or none, and loads that come together in any
// order of ranges.
namespace
{
enum class Kind
{
  spheres,
  radial,
  surface
};

/// Particles of many sizes that are thrown about in a box.
dem::Engine shaken_box(Kind kind, std::size_t n)
{
  const bool is_shaped = kind != Kind::spheres;
  const bool is_surface = kind == Kind::surface;
  dem::EngineParameters p;
  p.gravity = {0., 0., -9.81};
  p.particle.rolling_friction = 0.2;
  p.wall.rolling_friction = 0.1;
  p.geometry.wall_geometry =
      is_surface ? dem::ContactGeometry::surface : dem::ContactGeometry::radial;
  if (is_surface)
    p.geometry.geometry = dem::ContactGeometry::surface;
  p.breakage.fracture_energy = 10.;
  p.breakage.is_active = is_shaped;
  const auto series = std::make_shared<const dem::Coefficients>(
      dem::test::random_particle(12, 8));
  dem::Random random(5);
  std::vector<dem::ParticleShape> bodies;
  for (std::size_t k = 0; k < n; ++k)
  {
    const double radius = 2e-3 + 4e-3 * random.uniform();
    bodies.push_back(is_shaped ? dem::make_shape(series, radius)
                               : dem::make_sphere(radius));
  }
  std::sort(bodies.begin(), bodies.end(),
            [](const dem::ParticleShape &a, const dem::ParticleShape &b)
            { return a.volume > b.volume; });
  const double side = 0.016 * std::cbrt(static_cast<double>(n));
  const auto placements = dem::insert_particles(
      bodies, {dem::Vec3::Zero(), dem::Vec3::Constant(side), is_surface},
      random);
  dem::Engine engine(p);
  for (std::size_t k = 0; k < n; ++k)
  {
    engine.add_particle(bodies[k], placements[k].position,
                        placements[k].orientation);
    for (int d = 0; d < 3; ++d)
      engine.particles().velocity(k)[d] = 4. * (random.uniform() - 0.5);
  }
  for (int d = 0; d < 3; ++d)
  {
    dem::add_plane(engine, dem::Vec3::Zero(), dem::Vec3::Unit(d));
    dem::add_plane(engine, dem::Vec3::Constant(side), -dem::Vec3::Unit(d));
  }
  return engine;
}

bool is_same(const dem::Engine &a, const dem::Engine &b)
{
  const dem::ParticleSystem &one = a.particles(), &two = b.particles();
  return one.id == two.id &&
         std::memcmp(one.state.data(), two.state.data(),
                     one.size() * sizeof(dem::ParticleState)) == 0;
}

using Step = void (dem::Engine::*)(double time_step);

/// Through all that wants whole steps, in steps of two lengths.
void pass_through(dem::Engine &engine, Step step)
{
  const auto run = [&](int n_steps)
  {
    for (int k = 0; k < n_steps; ++k)
      (engine.*step)(k % 2 == 0 ? 2e-6 : 1e-6);
  };
  run(1000);
  engine.set_local_damping(0.3);
  run(999);
  engine.particles().velocity(3).x() += 1.;
  run(500);
  // Too small to meet any other in its corner.
  engine.add_particle(dem::make_sphere(1e-4), dem::Vec3::Constant(3e-4),
                      dem::Quaternion::Identity());
  run(99);
  engine.come_to_rest();
  run(99);
}

void expect_same(const dem::Engine &a, const dem::Engine &b)
{
  // Energies first: they too are those of whole steps.
  const dem::EngineEnergy one = a.energy(), two = b.energy();
  EXPECT_EQ(one.kinetic, two.kinetic);
  EXPECT_EQ(one.elastic, two.elastic);
  EXPECT_EQ(one.friction, two.friction);
  EXPECT_EQ(one.damping, two.damping);
  EXPECT_EQ(one.breakage, two.breakage);
  EXPECT_EQ(one.gravity_work, two.gravity_work);
  EXPECT_EQ(a.n_events(), b.n_events());
  EXPECT_EQ(a.n_rebuilds(), b.n_rebuilds());
  EXPECT_TRUE(is_same(a, b));
}

/// The walls come nearer, so that many particles meet.
void close_in(dem::Engine &engine)
{
  for (dem::Plane &plane : dem::planes(engine))
    plane.velocity = 3. * plane.normal;
}

/// From the centres, or from radii that the series gives [m].
double overlap_along_branch(const dem::Engine &engine, std::int32_t i,
                            std::int32_t j)
{
  const dem::ParticleSystem &particles = engine.particles();
  const auto a = static_cast<std::size_t>(i), b = static_cast<std::size_t>(j);
  const dem::Vec3 branch = particles.position(b) - particles.position(a);
  const auto reach = [&particles](std::size_t k, const dem::Vec3 &direction)
  {
    const dem::ParticleShape &body = particles.shape[k];
    return body.series
               ? body.scale * dem::radius(*body.series,
                                          particles.orientation(k).conjugate() *
                                              direction)
               : particles.radius(k);
  };
  const dem::Vec3 normal = branch.normalized();
  return reach(a, normal) + reach(b, -normal) - branch.norm();
}

/// Apart by some hundred micrometres along x, at rest.
dem::Engine two_particles(Kind kind)
{
  dem::EngineParameters p;
  if (kind == Kind::surface)
    p.geometry.geometry = dem::ContactGeometry::surface;
  p.breakage.is_active = false;
  const auto series = std::make_shared<const dem::Coefficients>(
      dem::test::random_particle(12, 8));
  const dem::ParticleShape body = kind == Kind::spheres
                                      ? dem::make_sphere(4e-3)
                                      : dem::make_shape(series, 4e-3);
  const double reach = body.circumscribed_radius;
  dem::Engine engine(p);
  for (const double side : {-1., 1.})
    engine.add_particle(body, dem::Vec3(side * (reach + 1e-5), 0., 0.),
                        dem::Quaternion::Identity());
  return engine;
}
} // namespace

TEST(ContactLoops, EveryInstructionSetGivesTheSameDigits)
{
  const dem::InstructionSet widest = dem::widest_instruction_set();
  for (const Kind kind : {Kind::spheres, Kind::radial, Kind::surface})
  {
    dem::use_instruction_set(dem::InstructionSet::baseline);
    dem::Engine reference = shaken_box(kind, 150);
    support::advance(reference, 2e-6, 2500);
    EXPECT_GT(reference.energy().friction, 0.);
    for (int set = 1; set <= static_cast<int>(widest); ++set)
    {
      dem::use_instruction_set(static_cast<dem::InstructionSet>(set));
      dem::Engine engine = shaken_box(kind, 150);
      support::advance(engine, 2e-6, 2500);
      EXPECT_TRUE(is_same(engine, reference))
          << dem::name_of(dem::instruction_set());
      EXPECT_EQ(engine.energy().friction, reference.energy().friction);
      EXPECT_EQ(engine.energy().damping, reference.energy().damping);
      EXPECT_EQ(engine.n_events(), reference.n_events());
    }
  }
  dem::use_instruction_set(widest);
}

// Enough particles to be put in spatial order: momentum and energy know
// nothing of it, and each id keeps its body.
TEST(ContactLoops, SortingInSpaceKeepsParticlesAndEnergy)
{
  dem::Engine engine = shaken_box(Kind::spheres, 2200);
  std::vector<double> radius(engine.particles().size());
  for (std::size_t k = 0; k < radius.size(); ++k)
    radius[k] = engine.particles().radius(k);
  const double start = engine.energy().kinetic;
  support::advance(engine, 2e-6, 3000);
  const dem::ParticleSystem &particles = engine.particles();
  EXPECT_FALSE(std::is_sorted(particles.id.begin(), particles.id.end()));
  for (std::size_t k = 0; k < particles.size(); ++k)
    EXPECT_EQ(particles.radius(k),
              radius[static_cast<std::size_t>(particles.id[k])]);
  EXPECT_GT(engine.energy().damping, 1e-3 * start);
  // First order in the step: 3.5e-5, half of it with half of the step.
  EXPECT_NEAR((support::energy_residual(engine) + start) / start, 0., 1e-4);
}

// Contacts that stand in one range or in many: the sum of all forces on the
// particles is what planes and gravity give, whatever the halo rows.
TEST(ContactLoops, PairsPushBothParticlesAlike)
{
  dem::Engine engine = shaken_box(Kind::spheres, 1500);
  support::advance(engine, 2e-6, 3000);
  dem::Vec3 sum = dem::Vec3::Zero();
  double size = 0.;
  for (const dem::ParticleLoad &load : engine.particles().load)
  {
    sum += load.force;
    size += load.force.norm();
  }
  for (const dem::Plane &plane : dem::planes(engine))
    sum += plane.force;
  ASSERT_GT(size, 0.);
  EXPECT_LT(sum.norm(), 1e-12 * size);
}

// Open pairs sleep until they could touch. Every pair that overlaps is a
// contact with that overlap: of spheres to round-off, of radii along the branch
// to what their expansions are wrong by.
TEST(ContactLoops, NoPairTouchesInItsSleep)
{
  for (const Kind kind : {Kind::spheres, Kind::radial})
  {
    dem::Engine engine = shaken_box(kind, 150);
    close_in(engine);
    std::int64_t n_touching = 0, n_inactive = 0;
    for (int round = 0; round < 100; ++round)
    {
      support::advance(engine, 2e-6, 10);
      const dem::ContactBatch &pairs = engine.pairs();
      std::map<std::pair<std::int32_t, std::int32_t>, double> found;
      for (std::size_t k = 0; k < pairs.size(); ++k)
      {
        found[{pairs.a[k], pairs.b[k]}] = pairs.overlap[k];
        n_inactive += pairs.reactivation[k] > 0.;
      }
      const auto n = static_cast<std::int32_t>(engine.particles().size());
      for (std::int32_t i = 0; i < n; ++i)
        for (std::int32_t j = i + 1; j < n; ++j)
          if (const double overlap = overlap_along_branch(engine, i, j);
              overlap > 1e-7)
          {
            ++n_touching;
            const auto pair = found.contains({i, j}) ? found.find({i, j})
                                                     : found.find({j, i});
            ASSERT_NE(pair, found.end());
            EXPECT_NEAR(pair->second, overlap,
                        kind == Kind::spheres ? 1e-15 : 1e-7);
          }
    }
    EXPECT_GT(n_touching, 300);
    EXPECT_GT(n_inactive, 1000);
  }
}

// Two particles that fly at each other without spin come nearer as fast as any
// two can: a contact that slept one per cent too long would begin with an
// overlap of many steps. Contact points of true surfaces sleep for a quarter of
// their gap.
TEST(ContactLoops, ParticlesThatMeetHeadOnWakeInTime)
{
  constexpr double speed = 1., step = 5e-9;
  for (const Kind kind : {Kind::spheres, Kind::radial, Kind::surface})
  {
    dem::Engine engine = two_particles(kind);
    for (int d = 0; d < 2; ++d)
      engine.particles().velocity(d).x() = d == 0 ? speed : -speed;
    const auto closed = [&] { return 2. * speed * engine.time(); };
    const auto path = [&]
    {
      const dem::ParticleSystem &particles = engine.particles();
      return kind == Kind::spheres
                 ? closed()
                 : particles.path_length[0] + particles.path_length[1];
    };
    struct Sleep
    {
      double closed, length, reactivation; // [m]
    };
    std::vector<Sleep> sleeps;
    while (engine.pairs().size() == 0 || !engine.pairs().is_touching(0))
    {
      ASSERT_LT(engine.n_steps(), 600000);
      engine.advance(step);
      if (engine.pairs().size() == 0)
        continue;
      const double reactivation = engine.pairs().reactivation[0];
      if (sleeps.empty() || reactivation != sleeps.back().reactivation)
        sleeps.push_back({closed(), reactivation - path(), reactivation});
    }
    EXPECT_LT(engine.pairs().overlap[0], 2.01 * speed * step);
    double longest = 0.; // share of the gap
    for (const Sleep &sleep : sleeps)
      if (const double gap = closed() - sleep.closed; gap > 2e-6)
        longest = std::max(longest, sleep.length / gap);
    EXPECT_NEAR(longest, kind == Kind::surface ? 0.25 : 1., 0.01);
  }
}

// A step far beyond what contacts bear throws the particles out: that is said
// before their contact points are no numbers.
TEST(MotionLoops, ParticlesThatLeapStopTheRun)
{
  dem::Engine engine = shaken_box(Kind::spheres, 60);
  try
  {
    for (int step = 0; step < 1000; ++step)
      engine.advance(1e-2);
    FAIL() << "no word of it";
  }
  catch (const std::runtime_error &stopped)
  {
    EXPECT_NE(std::string(stopped.what()).find("the step is too long"),
              std::string::npos);
  }
  for (std::size_t k = 0; k < engine.particles().size(); ++k)
    EXPECT_TRUE(engine.particles().position(k).allFinite());
}

// NaN is found in any lane and kind of motion; the message names the particle.
TEST(MotionLoops, ParticleWithoutFinitePositionStopsTheRun)
{
  for (const Kind kind : {Kind::spheres, Kind::radial, Kind::surface})
    for (const int what : {0, 1, 2})
      for (const std::size_t which : {0, 7, 59})
      {
        dem::Engine engine = shaken_box(kind, 60);
        engine.advance(1e-6);
        dem::ParticleSystem &particles = engine.particles();
        const double none = std::numeric_limits<double>::quiet_NaN();
        (what == 0   ? particles.position(which)
         : what == 1 ? particles.velocity(which)
                     : particles.spin(which))
            .y() = none;
        const std::string name =
            "particle " + std::to_string(particles.id[which]) + " has ";
        try
        {
          engine.advance(1e-6);
          ADD_FAILURE() << "ran on without " << name;
        }
        catch (const std::runtime_error &stopped)
        {
          EXPECT_NE(std::string(stopped.what()).find(name), std::string::npos)
              << stopped.what();
        }
      }
}

TEST(MotionLoops, ParticlesAreAddedAtFinitePositionsOnly)
{
  dem::Engine engine = shaken_box(Kind::spheres, 8);
  const dem::ParticleShape body = engine.particles().shape[0];
  const double none = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(engine.add_particle(body, dem::Vec3(0., none, 0.),
                                   dem::Quaternion::Identity()),
               std::invalid_argument);
}

// A step that nobody looks at leaves its last half kick to the next.
TEST(MotionLoops, UnseenStepsGiveTheSameDigits)
{
  for (const Kind kind : {Kind::spheres, Kind::radial, Kind::surface})
  {
    dem::Engine seen = shaken_box(kind, 60), unseen = shaken_box(kind, 60);
    pass_through(seen, &dem::Engine::advance);
    pass_through(unseen, &dem::Engine::advance_deferred);
    unseen.synchronize();
    expect_same(seen, unseen);
    EXPECT_GT(seen.energy().kinetic, 0.);
    EXPECT_EQ(seen.n_events() > 0, kind != Kind::spheres);

    seen.advance(2e-6);
    unseen.advance_deferred(2e-6);
    unseen.synchronize();
    std::ostringstream out(std::ios::binary);
    unseen.save(out, {});
    dem::Engine other = shaken_box(kind, 60);
    other.advance_deferred(2e-6); // owed by particles that are no more
    std::istringstream in(out.str(), std::ios::binary);
    other.restore(in, {});
    expect_same(seen, other);
  }
}

// Const functions neither finish a pending half kick nor show late velocities.
TEST(MotionLoops, ConstFunctionsRefuseAPendingHalfKick)
{
  dem::Engine engine = shaken_box(Kind::spheres, 10);
  const dem::Engine &seen = engine;
  engine.advance_deferred(2e-6);
  std::ostringstream out(std::ios::binary);
  EXPECT_THROW(seen.particles(), std::logic_error);
  EXPECT_THROW(seen.energy(), std::logic_error);
  EXPECT_THROW(seen.save(out, {}), std::logic_error);
  engine.synchronize();
  EXPECT_NO_THROW(seen.particles());
  EXPECT_NO_THROW(seen.energy());
  EXPECT_NO_THROW(seen.save(out, {}));
  engine.advance_deferred(2e-6);
  EXPECT_NO_THROW(engine.particles()); // finishes it
  EXPECT_NO_THROW(seen.particles());
}
