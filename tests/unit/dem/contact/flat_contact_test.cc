#include <dem/boundary/wall_refinement.h>

#include <gtest/gtest.h>

#include <shape/test_shapes.h>

// Contact points at which a particle is nearly flat: r = r0 (1 + a P2(cos
// theta)) has the curvature (1 + 4 a) / (r0 (1 + a)^2) at its poles.
namespace
{
using dem::Vec3;

constexpr double size = 0.01, flatness = -0.248; // r0 [m], a [-]
constexpr double pole = size * (1. + flatness);

dem::ParticleShape flat_particle()
{
  return dem::shape_of(dem::test::project(
      2, [](const Vec3 &s)
      { return size * (1. + flatness * (1.5 * s.z() * s.z() - 0.5)); }));
}

/// A direction some way from the pole [rad].
Vec3 beside(double pole_z, double angle)
{
  return {std::sin(angle), 0., pole_z * std::cos(angle)};
}

constexpr double overlap = 1e-3 * size;
} // namespace

TEST(FlatContact, IsReachedAlongAPlane)
{
  const dem::ParticleShape particle = flat_particle();
  const dem::Support found =
      dem::find_support(particle, Vec3::UnitZ(), beside(1., 0.1));
  EXPECT_TRUE(found.is_found);
  EXPECT_NEAR(found.height, pole, 1e-9 * size);
}

TEST(FlatContact, IsReachedOnAnEndOfADrum)
{
  const dem::ParticleShape particle = flat_particle();
  dem::Drum drum;
  drum.axis = Vec3::UnitZ();
  drum.radius = 0.1;
  drum.length = 0.2;
  const Vec3 position(0., 0., pole - overlap - 0.5 * drum.length);
  dem::ParticleView view(particle, position, dem::Mat3::Identity(), 0.);
  dem::WallContactPoint start;
  start.on_particle = beside(-1., 0.1);
  const dem::WallContactPoint found =
      dem::refine_on_drum(view, drum, dem::DrumPart::lower_end, start);
  EXPECT_TRUE(found.is_found);
  EXPECT_NEAR(found.overlap, overlap, 1e-9 * size);
}

TEST(FlatContact, IsReachedBetweenParticles)
{
  const dem::ParticleShape particle = flat_particle();
  const dem::RelativePose above{{0., 0., 2. * pole - overlap},
                                dem::Mat3::Identity()};
  const dem::ContactPoint found =
      dem::refine(particle, particle, above,
                  {beside(1., 0.1), beside(-1., -0.1), 0., false});
  EXPECT_TRUE(found.is_found);
  EXPECT_NEAR(found.overlap, overlap, 1e-9 * size);
}

// The height of a surface along a normal has a maximum above every start. Steps
// of Newton alone miss it on the sides of a rounded cube, which are flat or
// hollow in parts.
TEST(FlatContact, SupportOfACubeIsFoundFromAside)
{
  const dem::ParticleShape cube = dem::make_shape(
      std::make_shared<const dem::Coefficients>(dem::test::project(
          16, [](const Vec3 &s)
          { return 0.01 * std::pow(s.array().pow(4.).sum(), -0.25); })),
      0.01);
  constexpr int n = 5000;
  int n_missed = 0;
  const std::vector<Vec3> tilts = dem::test::random_directions(n, 1),
                          aside = dem::test::random_directions(n, 2);
  for (std::size_t k = 0; k < n; ++k)
  {
    const Vec3 normal = (Vec3::UnitZ() + 0.03 * tilts[k]).normalized();
    const Vec3 start = (normal + 0.6 * aside[k]).normalized();
    const dem::Support support = dem::find_support(cube, normal, start);
    n_missed += !support.is_found;
    EXPECT_GT(support.height, 0.0086) << k;
  }
  // 59 with Newton's steps alone; those left end where it is nearly flat.
  EXPECT_LE(n_missed, 25);
}
