#include <dem/neighbor/candidates.h>
#include <dem/neighbor/near_pairs.h>
#include <dem/packing/insertion.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <shape/test_shapes.h>

namespace
{
/// Spheres of sizes 9 : 1, anywhere in a box.
dem::ParticleSystem cloud(std::size_t n)
{
  dem::ParticleSystem particles;
  dem::Random random(3);
  for (std::size_t k = 0; k < n; ++k)
  {
    const double radius = 2.5e-3 * std::pow(9., random.uniform());
    particles.add(
        dem::make_sphere(radius),
        0.2 * dem::Vec3(random.uniform(), random.uniform(), random.uniform()),
        dem::Quaternion::Identity(), 2700.);
  }
  return particles;
}

std::vector<dem::PairKey> by_brute_force(const dem::ParticleSystem &particles,
                                         double margin)
{
  std::vector<dem::PairKey> pairs;
  for (std::size_t i = 0; i < particles.size(); ++i)
    for (std::size_t j = i + 1; j < particles.size(); ++j)
      if ((particles.position(j) - particles.position(i)).norm() -
              particles.radius(i) - particles.radius(j) <
          margin)
      {
        const auto a = static_cast<std::int32_t>(i),
                   b = static_cast<std::int32_t>(j);
        pairs.push_back(particles.is_junior(i, j) ? dem::PairKey(a, b)
                                                  : dem::PairKey(b, a));
      }
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}
} // namespace

TEST(NearPairs, AreThoseOfBruteForceForSizesNineToOne)
{
  dem::ParticleSystem particles = cloud(600);
  dem::PairFinder finder;
  dem::PathLengths paths;
  dem::Random random(7);
  // What is kept from call to call must not change what is found.
  for (int call = 0; call < 12; ++call)
  {
    const double margin = call % 3 == 0 ? 2e-3 : 1e-3;
    EXPECT_EQ(
        finder.find(particles, dem::ContactGeometry::sphere, margin, paths),
        by_brute_force(particles, margin))
        << "call " << call;
    for (dem::ParticleState &particle : particles.state)
      for (int d = 0; d < 3; ++d)
        particle.position[d] +=
            5e-4 / std::sqrt(3.) * (2. * random.uniform() - 1.);
    paths.centres += 2. * 5e-4;
    paths.gaps += 2. * 5e-4;
  }
}

TEST(NearPairs, AreThoseOfBruteForceForParticlesThatMoveAtTheirOwnPace)
{
  const auto series = std::make_shared<const dem::Coefficients>(
      dem::test::random_particle(8, 8));
  dem::Random random(5);
  dem::ParticleSystem particles;
  for (int k = 0; k < 150; ++k)
    particles.add(
        dem::make_shape(series, 4e-3 + 4e-3 * random.uniform()),
        0.07 * dem::Vec3(random.uniform(), random.uniform(), random.uniform()),
        random.rotation(), 2700.);
  const double slope = 1. + dem::steepness(particles);
  dem::PairFinder kept;
  dem::PathLengths paths;
  std::size_t n_found = 0;
  for (int call = 0; call < 12; ++call)
  {
    dem::PairFinder knows_nothing;
    const auto found =
        kept.find(particles, dem::ContactGeometry::radial, 5e-4, paths);
    EXPECT_EQ(found, knows_nothing.find(particles, dem::ContactGeometry::radial,
                                        5e-4, paths))
        << "call " << call;
    n_found += found.size();
    // Every tenth particle is quick, the others creep.
    for (std::size_t k = 0; k < particles.size(); ++k)
    {
      const double pace = k % 10 == 0 ? 4e-4 : 1e-5;
      particles.position(k) += pace * (random.rotation() * dem::Vec3::UnitX());
      particles.path_length[k] += slope * pace;
    }
    paths.centres += 2. * 4e-4;
  }
  EXPECT_GT(n_found, 1000u);
}

TEST(NearPairs, NoParticlesNoPairs)
{
  dem::PairFinder finder;
  EXPECT_TRUE(finder.find({}, dem::ContactGeometry::sphere, 1e-3, {}).empty());
}
