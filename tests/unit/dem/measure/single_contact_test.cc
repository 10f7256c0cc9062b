#include "dem_scene.h"

#include <dem/measure/single_contact.h>

#include <gtest/gtest.h>

#include <shape/test_shapes.h>

using dem::ContactGeometry;
using dem::ContactState;
using dem::PosedParticle;
using dem::Vec3;

namespace
{
constexpr double radius_a = 0.01, radius_b = 0.015, overlap = 2e-5;
constexpr std::array<ContactGeometry, 3> geometries{
    ContactGeometry::sphere, ContactGeometry::radial, ContactGeometry::surface};

dem::EngineParameters in(ContactGeometry geometry)
{
  dem::EngineParameters p;
  p.geometry.geometry = p.geometry.wall_geometry = geometry;
  return p;
}

/// A sphere given as a series, so that it is met as a shape.
dem::ParticleShape series_sphere(double radius)
{
  return dem::make_shape(
      std::make_shared<const dem::Coefficients>(
          dem::test::project(4, [](const Vec3 &) { return 1.; })),
      radius);
}

/// B is above A along this direction, with the overlap of above.
PosedParticle above(const Vec3 &direction, const dem::ParticleShape &shape)
{
  PosedParticle b{shape};
  b.position = (radius_a + radius_b - overlap) * direction;
  return b;
}

/// Hertz, 4/3 E* sqrt(R*) delta^(3/2), E* = G / (1 - nu) of equal solids [N].
double hertz_force(const dem::ParticleMaterial &m, double reduced_radius)
{
  return 4. / 3. * m.shear_modulus / (1. - m.poisson_ratio) *
         std::sqrt(reduced_radius) * std::pow(overlap, 1.5);
}

double sphere_mass(const dem::ParticleMaterial &m, double radius)
{
  return m.density * 4. / 3. * std::numbers::pi * std::pow(radius, 3);
}

/// The moment that the forces at the contact points make about `centre`.
Vec3 moment_of(const ContactState &state, const Vec3 &centre)
{
  Vec3 sum = Vec3::Zero();
  for (const dem::LoadedContactPoint &at : state.points)
    sum += (at.point - centre).cross(at.force);
  return sum;
}
} // namespace

TEST(SingleContact, SpheresPressByHertz)
{
  const Vec3 up = Vec3(1., 2., 3.).normalized();
  const double reduced = radius_a * radius_b / (radius_a + radius_b);
  for (const ContactGeometry geometry : geometries)
    for (const bool is_series : {false, true})
    {
      const dem::EngineParameters p = in(geometry);
      const PosedParticle a{is_series ? series_sphere(radius_a)
                                      : dem::make_sphere(radius_a)};
      const ContactState state =
          evaluate_contact(p, a, above(up, dem::make_sphere(radius_b)));
      ASSERT_EQ(state.points.size(), 1U);
      const dem::LoadedContactPoint &at = state.points[0];
      const double force = hertz_force(p.particle, reduced);
      // Series keep directions and curvatures to seven digits; the overlap is a
      // small difference of distances, good to 1e-12.
      const double tolerance = is_series ? 1e-5 : 1e-10;
      EXPECT_NEAR(at.overlap, overlap, tolerance * overlap + 1e-16);
      EXPECT_LT((at.normal - up).norm(), 1e-6);
      EXPECT_LT((at.point - (radius_a - 0.5 * overlap) * up).norm(), 1e-8);
      EXPECT_NEAR(state.on_a.force.norm(), force, 2. * tolerance * force);
      EXPECT_LT((state.on_a.force + force * up).norm(), 1e-5 * force);
      EXPECT_LT((state.on_b.force + state.on_a.force).norm(), 1e-12 * force);
      EXPECT_LT(state.on_a.moment.norm(), 1e-6 * force * radius_a);
      EXPECT_NEAR(at.stored_energy, 0.4 * force * overlap,
                  2. * tolerance * force * overlap);
    }
}

// 2 beta sqrt(m* k) v with the tangent stiffness k = 2 E* sqrt(R* delta).
TEST(SingleContact, DashpotActsAtTheVelocityGiven)
{
  const dem::EngineParameters p = in(ContactGeometry::sphere);
  const double reduced = radius_a * radius_b / (radius_a + radius_b);
  const double m_a = sphere_mass(p.particle, radius_a),
               m_b = sphere_mass(p.particle, radius_b);
  const double elastic = hertz_force(p.particle, reduced),
               stiffness = 1.5 * elastic / overlap, speed = 0.01;
  const PosedParticle a{dem::make_sphere(radius_a)};
  PosedParticle b = above(Vec3::UnitZ(), dem::make_sphere(radius_b));
  b.velocity.z() = -speed;
  const ContactState state = evaluate_contact(p, a, b);
  const double expected =
      elastic + 2. * p.particle.normal_damping *
                    std::sqrt(m_a * m_b / (m_a + m_b) * stiffness) * speed;
  EXPECT_NEAR(-state.on_a.force.z(), expected, 1e-10 * expected);
}

// Tangential motion loads both with force and moment about their own centres.
TEST(SingleContact, TangentialForceTurnsBoth)
{
  dem::EngineParameters p = in(ContactGeometry::sphere);
  p.particle.rolling_friction = 0.;
  const PosedParticle a{dem::make_sphere(radius_a)};
  PosedParticle b = above(Vec3::UnitZ(), dem::make_sphere(radius_b));
  b.velocity.x() = 1e-4;
  const ContactState state = evaluate_contact(p, a, b, 1e-6);
  ASSERT_GT(state.on_a.force.x(), 0.);
  const double scale = state.on_a.force.x() * radius_a;
  // Contact points lie in the middle of the overlap, levers end on it.
  EXPECT_LT((moment_of(state, a.position) - state.on_a.moment).norm(),
            2e-3 * scale);
  EXPECT_LT((-moment_of(state, b.position) - state.on_b.moment).norm(),
            2e-3 * scale);
}

TEST(SingleContact, NothingActsAcrossAGap)
{
  PosedParticle b = above(Vec3::UnitX(), dem::make_sphere(radius_b));
  b.position *= 1.01;
  b.velocity.x() = -1.;
  const ContactState state = evaluate_contact(
      in(ContactGeometry::sphere), {dem::make_sphere(radius_a)}, b, 1e-6);
  EXPECT_TRUE(state.points.empty());
  EXPECT_EQ(state.on_a.force, Vec3::Zero());
}

TEST(SingleContact, WallsPressByTheirLaw)
{
  for (const ContactGeometry geometry : geometries)
    for (const bool is_hertz : {false, true})
    {
      dem::EngineParameters p = in(geometry);
      p.wall.law = is_hertz ? "hertz" : "linear";
      p.surface = p.wall;
      PosedParticle a{dem::make_sphere(radius_a)};
      a.position.z() = radius_a - overlap;
      // A rigid plate: E* is twice that of two solids.
      const double force = is_hertz ? 2. * hertz_force(p.particle, radius_a)
                                    : p.wall.normal_stiffness * overlap;
      const ContactState on_plane = evaluate_contact(p, a, dem::Plane{});
      dem::FacetSurface floor = support::coplanar_fan(6, 0.05, 0.3);
      const ContactState on_facets = evaluate_contact(p, a, floor);
      for (const ContactState *state : {&on_plane, &on_facets})
      {
        ASSERT_EQ(state->points.size(), 1U);
        EXPECT_NEAR(state->points[0].overlap, overlap, 1e-15);
        EXPECT_LT((state->points[0].normal + Vec3::UnitZ()).norm(), 1e-12);
        EXPECT_LT(state->points[0].point.norm(), 1e-4 * radius_a);
        EXPECT_NEAR(state->on_a.force.z(), force, 1e-9 * force);
        EXPECT_LT((state->on_a.force + state->on_b.force).norm(), 1e-12);
      }
      Vec3 sum = Vec3::Zero();
      for (const Vec3 &load : floor.load)
        sum += load;
      EXPECT_LT((sum - on_facets.on_b.force).norm(), 1e-12 * force);
    }
}

// The same scene, brought there by one step of the engine.
TEST(SingleContact, SaysWhatTheEngineDoes)
{
  constexpr double dt = 1e-7;
  for (const ContactGeometry geometry : geometries)
    for (const unsigned seed : {1U, 2U, 3U})
    {
      dem::EngineParameters p = in(geometry);
      p.breakage.is_active = false;
      std::array<PosedParticle, 2> of;
      for (unsigned k = 0; k < 2; ++k)
      {
        of[k].shape =
            dem::make_shape(std::make_shared<const dem::Coefficients>(
                                dem::test::random_particle(8, seed + 10 * k)),
                            0.01);
        of[k].orientation = dem::Quaternion(
            Eigen::AngleAxisd(0.3 + k, Vec3(1., seed, 2.).normalized()));
        of[k].velocity = Vec3(0.02, -0.01 * seed, 0.1) * (k == 0 ? 1. : -1.);
      }
      of[1].position = Vec3(0.002, 0.001, 0.017);
      dem::Engine engine(p);
      for (const PosedParticle &one : of)
      {
        engine.add_particle(one.shape, one.position - dt * one.velocity,
                            one.orientation);
        engine.particles().velocity(engine.particles().size() - 1) =
            one.velocity;
      }
      engine.advance(dt);
      const ContactState state = evaluate_contact(p, of[0], of[1], dt);
      const dem::ParticleLoad &load = engine.particles().load[0];
      const double size = load.force.norm();
      ASSERT_GT(size, 0.) << static_cast<int>(geometry) << ' ' << seed;
      EXPECT_LT((state.on_a.force - load.force).norm(), 1e-9 * size);
      EXPECT_LT((state.on_a.moment - load.moment).norm(), 1e-9 * size * 0.01);
      EXPECT_LT((state.on_b.moment - engine.particles().load[1].moment).norm(),
                1e-9 * size * 0.01);
    }
}
