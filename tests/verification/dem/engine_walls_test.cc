#include "dem_scene.h"
#include "wall_meshes.h"

#include <dem/boundary/wall_contact_points.h>
#include <dem/engine_boundaries.h>
#include <dem/random.h>

#include <gtest/gtest.h>

#include <shape/test_shapes.h>

// Particles that meet drums and facets with their true surfaces.
namespace
{
using dem::Vec3;

dem::EngineParameters surface_parameters()
{
  dem::EngineParameters p = support::bare_parameters();
  p.geometry.geometry = p.geometry.wall_geometry =
      dem::ContactGeometry::surface;
  // Of third power is what the expansions are out by.
  p.geometry.refresh_tolerance = 5e-4;
  p.wall.normal_stiffness = 1e6;
  p.wall.shear_stiffness = 0.85e6;
  p.surface = p.wall;
  p.geometry.usual_skin = 1e-3;
  return p;
}

std::shared_ptr<const dem::Coefficients> rough_particle(unsigned seed)
{
  return std::make_shared<const dem::Coefficients>(
      dem::test::random_particle(10, seed));
}

dem::Drum small_drum()
{
  dem::Drum drum;
  drum.radius = 0.05;
  drum.length = 0.06;
  drum.lifter_height = 0.012;
  drum.lifter_thickness = 0.006;
  return drum;
}

/// A particle thrown about inside.
void throw_particle(dem::Engine &engine, unsigned seed)
{
  dem::Random random(seed);
  engine.add_particle(dem::make_shape(rough_particle(seed), 0.01), Vec3::Zero(),
                      random.rotation());
  for (int d = 0; d < 3; ++d)
  {
    engine.particles().velocity(0)[d] = 2. * (random.uniform() - 0.5);
    engine.particles().spin(0)[d] = 60. * (random.uniform() - 0.5);
  }
}

/// What a run has done with its energy.
struct EnergyRecord
{
  double drift = 0.;                 ///< largest, over the energy [-]
  double non_conservative_work = 0.; ///< at the end, over the energy [-]
  double stored = 0.;                ///< most, over the energy [-]
};

/// Inside a box, its sides bent in and out, with edges and vertices.
dem::FacetSurface rough_box(double size, int n, double roughness)
{
  dem::FacetSurface all;
  const Vec3 middle = Vec3::Constant(0.5 * size);
  for (int d = 0; d < 3; ++d)
    for (const double side : {-1., 1.})
    {
      const dem::FacetSurface floor =
          support::flat_floor(1.4 * size / n, n, roughness,
                              static_cast<unsigned>(3 * d) + (side > 0.));
      const dem::Quaternion turn = dem::Quaternion::FromTwoVectors(
          Vec3::UnitZ(), Vec3(-side * Vec3::Unit(d)));
      const auto first = static_cast<std::int32_t>(all.position.size());
      for (const Vec3 &x : floor.position)
        all.position.push_back(middle + 0.5 * side * size * Vec3::Unit(d) +
                               turn * x);
      for (const auto &v : floor.triangles)
        all.triangles.push_back({first + v[0], first + v[1], first + v[2]});
    }
  support::complete(all);
  return all;
}

EnergyRecord run(dem::Engine &engine, double time_step, double end)
{
  const double start = engine.energy().kinetic;
  EnergyRecord record;
  while (engine.time() < end)
  {
    engine.advance(time_step);
    const dem::EngineEnergy e = engine.energy();
    record.stored = std::max(record.stored, e.elastic / start);
    record.drift =
        std::max(record.drift, std::abs((e.kinetic + e.elastic) / start - 1.));
  }
  record.non_conservative_work = engine.energy().non_conservative_work / start;
  return record;
}
} // namespace

// Springs alone, over some ten hits on the cylinder, the ends and the lifter:
// what is left goes with the square of the step, 1.2e-4 at most here.
TEST(SurfaceOnDrum, ParticleKeepsItsEnergy)
{
  for (unsigned seed = 2; seed <= 5; ++seed)
  {
    dem::Engine engine(surface_parameters());
    dem::set_drum(engine, small_drum());
    throw_particle(engine, seed);
    const EnergyRecord record = run(engine, 2e-6, 0.12);
    EXPECT_GT(record.stored, 0.1) << seed;
    EXPECT_LT(record.drift, 3e-4) << seed;
    EXPECT_LT(std::abs(record.non_conservative_work), 1e-3) << seed;
    EXPECT_EQ(engine.contact_point_events().n_jumps, 0);
    EXPECT_EQ(engine.contact_point_events().n_ended, 0);
    EXPECT_EQ(engine.contact_point_events().n_late, 0);
  }
}

// A flat mesh acts as the plane: the same load for any particle and pose.
TEST(SurfaceOnFacets, FlatMeshActsAsThePlane)
{
  dem::EngineParameters p = surface_parameters();
  p.geometry.refresh_tolerance = 0.;
  const dem::FacetSurface floor = support::flat_floor(0.006, 20, 0.);
  for (unsigned seed = 1; seed <= 30; ++seed)
  {
    dem::Random random(seed);
    const auto series = rough_particle(seed);
    const dem::ParticleShape body = dem::make_shape(series, 0.01);
    const dem::Quaternion turned = random.rotation();
    const dem::RadiusMap map(series);
    const double height =
        dem::find_supports({body, map},
                           turned.conjugate() * Vec3(-Vec3::UnitZ()),
                           {body.inscribed_radius, 0.})
            .at(0)
            .overlap;
    const Vec3 centre(0.004 * random.uniform(), 0.004 * random.uniform(),
                      height - 1e-5);
    dem::Engine on_plane(p), on_mesh(p);
    dem::add_plane(on_plane, Vec3::Zero(), Vec3::UnitZ());
    dem::attach_surface(on_mesh, floor);
    for (dem::Engine *engine : {&on_plane, &on_mesh})
    {
      engine->add_particle(body, centre, turned);
      engine->advance(1e-12);
    }
    const dem::ParticleLoad &exact = on_plane.particles().load[0],
                            &found = on_mesh.particles().load[0];
    ASSERT_GT(exact.force.z(), 1.);
    // Contacts keep their normals in single precision, 6e-8: 2e-8 and 8e-8 were
    // found.
    EXPECT_LT((found.force - exact.force).norm(), 1e-7 * exact.force.norm());
    EXPECT_LT((found.moment - exact.moment).norm(),
              2e-7 * 0.01 * exact.force.norm());
    // What the particle gets the vertices give.
    Vec3 sum = Vec3::Zero();
    for (const Vec3 &load : dem::surface(on_mesh).load)
      sum += load;
    EXPECT_LT((sum + found.force).norm(), 1e-12 * exact.force.norm());
  }
}

// Springs alone, between sides with edges and vertices that stand in and out:
// what is left goes with the square of the step, down to what ridges between
// contact points are out by, and no contact point is lost. One that arises over
// a ridge beside another one has no force yet, and may be found late.
TEST(SurfaceOnFacets, ParticleKeepsItsEnergy)
{
  for (const double roughness : {0., 0.15, 0.4})
  {
    double coarse = 0., fine = 0.;
    for (unsigned seed = 1; seed <= 4; ++seed)
      for (double *drift : {&coarse, &fine})
      {
        dem::Engine engine(surface_parameters());
        dem::attach_surface(engine, rough_box(0.06, 5, roughness));
        throw_particle(engine, seed);
        engine.particles().position(0) = Vec3::Constant(0.03);
        const EnergyRecord record =
            run(engine, drift == &coarse ? 4e-6 : 1e-6, 0.08);
        EXPECT_GT(record.stored, 0.1);
        EXPECT_LT(std::abs(record.non_conservative_work), 1e-3);
        *drift += record.drift;
        const dem::ContactPointEvents &events = engine.contact_point_events();
        EXPECT_EQ(events.n_jumps + events.n_ended, 0);
        EXPECT_LE(events.n_late, 1);
        EXPECT_EQ(events.n_unlisted, 0);
      }
    // Largest of all steps: its phase in an oscillation is by chance.
    EXPECT_LT(coarse, 4 * 5e-4) << roughness;
    EXPECT_LT(fine, 4 * 1.5e-4) << roughness;
    EXPECT_GT(coarse / fine, roughness == 0. ? 8. : 2.) << roughness;
  }
}

// A sphere on both faces of a flat fold, and on the ridge between them: the
// forces on the faces less that on the edge.
TEST(SurfaceOnFacets, RidgesCountOnce)
{
  constexpr double radius = 0.01, slope = 0.03, depth = 1e-5;
  const double c = std::cos(slope), s = std::sin(slope);
  dem::FacetSurface fold;
  for (const double side : {-1., 0., 1.})
    for (const double y : {-0.02, 0.02})
      fold.position.emplace_back(0.02 * side * c, y, 0.02 * std::abs(side) * s);
  fold.triangles = {{0, 1, 2}, {1, 3, 2}, {2, 3, 4}, {3, 5, 4}};
  support::complete(fold);
  const auto sphere = std::make_shared<const dem::Coefficients>(
      dem::test::project(8, [](const Vec3 &) { return 1.; }));
  const dem::EngineParameters p = surface_parameters();
  double largest_ridge = 0.;
  for (int step = -4; step <= 4; ++step)
  {
    const double x = 0.2 * step * radius * s, z = (radius - depth) / c;
    dem::Engine engine(p);
    dem::attach_surface(engine, fold);
    engine.add_particle(dem::make_shape(sphere, radius), Vec3(x, 0., z),
                        dem::Quaternion::Identity());
    engine.advance(1e-12);
    const double left = radius - (z * c + x * s),
                 right = radius - (z * c - x * s),
                 ridge = std::max(0., radius - std::hypot(x, z));
    const Vec3 exact = p.surface.normal_stiffness *
                       (left * Vec3(s, 0., c) + right * Vec3(-s, 0., c) -
                        ridge * Vec3(x, 0., z).normalized());
    const Vec3 &found = engine.particles().load[0].force;
    EXPECT_LT((found - exact).norm(), 2e-4 * exact.norm()) << x;
    largest_ridge = std::max(largest_ridge, ridge);
  }
  EXPECT_GT(largest_ridge, 0.5 * depth);
}

// A cylinder of facets nears the cylinder with the square of their width.
TEST(SurfaceOnFacets, FacetsOfACylinderConverge)
{
  dem::EngineParameters p = surface_parameters();
  const double radius = 0.05;
  dem::Drum drum;
  drum.axis = Vec3::UnitZ();
  drum.radius = radius;
  drum.length = 1.;
  double before = 0.;
  for (const int n : {64, 128, 256, 512})
  {
    const dem::FacetSurface mesh =
        support::cylinder_inside(radius, 0.1, n, std::max(2, n / 4));
    double worst = 0.;
    for (unsigned seed = 1; seed <= 12; ++seed)
    {
      dem::Random random(seed);
      const auto series = rough_particle(seed);
      const dem::ParticleShape body = dem::make_shape(series, 0.01);
      const dem::RadiusMap map(series);
      const dem::Quaternion turned = random.rotation();
      const double phi = 6. * random.uniform();
      const Vec3 out(std::cos(phi), std::sin(phi), 0.);
      dem::MappedParticlePose particle{
          {body, map}, Vec3::Zero(), turned.matrix()};
      double depth = -1.;
      for (double at = 0.035; depth < 5e-5;)
      {
        particle.position = at * out;
        const auto found =
            dem::find_on_drum(particle, drum, dem::DrumPart::cylinder, 2e-3);
        depth = found.contact_points.empty()
                    ? -2e-3
                    : found.contact_points.front().overlap;
        at += std::max(1e-5 - std::min(depth, 0.), 1e-5);
      }
      std::vector<double> force;
      for (const bool is_mesh : {false, true})
      {
        dem::Engine engine(p);
        if (is_mesh)
          dem::attach_surface(engine, mesh);
        else
          dem::set_drum(engine, drum);
        engine.add_particle(body, particle.position, turned);
        engine.advance(1e-12);
        force.push_back(engine.particles().load[0].force.norm());
      }
      worst = std::max(worst, std::abs(force[1] / force[0] - 1.));
    }
    if (before > 0.)
    {
      EXPECT_NEAR(before / worst, 4., 0.15) << n;
    }
    before = worst;
  }
}

// Beyond a plane or a drum nothing would bring a particle back.
TEST(EngineWalls, AParticleThatHasComeThroughIsNamed)
{
  for (const bool in_drum : {false, true})
  {
    dem::Engine engine(support::deep_parameters());
    dem::Drum drum;
    drum.radius = 0.1;
    drum.length = 0.2;
    if (in_drum)
      dem::set_drum(engine, drum);
    else
      dem::add_plane(engine, Vec3(0.1, 0., 0.), -Vec3::UnitX());
    support::add_sphere(engine, 0.01, Vec3(0.099, 0., 0.));
    EXPECT_NO_THROW(engine.advance(1e-9));
    engine.particles().position(0).x() = 0.109; // most of it
    dem::add_plane(engine, Vec3(-0.2, 0., 0.),
                   Vec3::UnitX()); // lists are rebuilt
    EXPECT_NO_THROW(engine.advance(1e-9));
    engine.particles().position(0).x() = 0.111;
    dem::add_plane(engine, Vec3(-0.3, 0., 0.), Vec3::UnitX());
    try
    {
      engine.advance(1e-9);
      FAIL();
    }
    catch (const std::runtime_error &error)
    {
      EXPECT_NE(std::string(error.what()).find("particle 0 of "),
                std::string::npos);
      EXPECT_NE(std::string(error.what()).find("come through a wall"),
                std::string::npos);
    }
    engine.allow_escape(); // of rough packings
    EXPECT_NO_THROW(engine.advance(1e-9));
  }
}
