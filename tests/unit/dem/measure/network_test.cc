#include "dem_scene.h"
#include "packings.h"

#include <dem/engine_boundaries.h>

#include <gtest/gtest.h>

namespace
{
using packings::radius;

double same(const dem::Vec3 &)
{
  return 3.;
}

std::vector<dem::PairContact>
with_normals(const std::vector<dem::Vec3> &normals)
{
  std::vector<dem::PairContact> pairs(normals.size());
  for (std::size_t k = 0; k < normals.size(); ++k)
    pairs[k].normal = normals[k];
  return pairs;
}

/// Spheres one on the other along these unit steps.
std::vector<dem::Vec3> path(const std::vector<dem::Vec3> &steps)
{
  std::vector<dem::Vec3> centres = {dem::Vec3::Zero()};
  for (const dem::Vec3 &step : steps)
    centres.push_back(centres.back() + 2. * radius * step);
  return centres;
}

dem::Vec3 tilted(double degrees)
{
  const double angle = degrees * std::numbers::pi / 180.;
  return {std::sin(angle), 0., std::cos(angle)};
}

dem::ForceChains chains_of(const packings::Packing &packing)
{
  return dem::force_chains(packing.particles, packing.network);
}
} // namespace

TEST(Fabric, OfCubicPackingsIsIsotropic)
{
  for (const auto &centres :
       {packings::simple_cubic(4), packings::face_centred(2)})
  {
    const dem::Mat3 fabric =
        dem::fabric_tensor(packings::touching(centres, same).network.pairs);
    EXPECT_NEAR(fabric.trace(), 1., 1e-14);
    EXPECT_NEAR(dem::fabric_anisotropy(fabric), 0., 1e-13);
  }
}

// Normals on a cone round z: phi_zz = cos^2, anisotropy
// 15/2 (phi_zz - phi_xx) = 15/2 (3 cos^2 - 1) / 2.
TEST(Fabric, OfAConeIsThatOfItsAngle)
{
  for (const double angle : {0., 0.4, 0.8, 1.2})
  {
    std::vector<dem::Vec3> normals;
    for (int k = 0; k < 12; ++k)
    {
      const double turn = 2. * std::numbers::pi * k / 12.;
      normals.emplace_back(std::sin(angle) * std::cos(turn),
                           std::sin(angle) * std::sin(turn), std::cos(angle));
    }
    const dem::Mat3 fabric = dem::fabric_tensor(with_normals(normals));
    EXPECT_NEAR(fabric(2, 2), std::pow(std::cos(angle), 2), 1e-14);
    EXPECT_NEAR(dem::fabric_anisotropy(fabric),
                7.5 * std::abs(0.5 * (3. * std::pow(std::cos(angle), 2) - 1.)),
                1e-13);
  }
}

TEST(Fabric, OfNoContactsIsZero)
{
  EXPECT_EQ(dem::fabric_tensor({}).norm(), 0.);
  EXPECT_EQ(dem::sliding_fraction({}), 0.);
  EXPECT_EQ(dem::strong_share({}), 0.);
}

TEST(StrongContacts, AreAboveTheMean)
{
  // Along z 5 N, across 2 N: the mean is 3 N in a cube.
  const auto packing =
      packings::touching(packings::simple_cubic(3), [](const dem::Vec3 &normal)
                         { return normal.z() > 0.5 ? 5. : 2.; });
  EXPECT_DOUBLE_EQ(dem::strong_share(packing.network.pairs), 1. / 3.);
}

// A sphere between two forces F at its poles: sigma_zz = F 2 r / V.
TEST(ParticleStress, OfASphereBetweenTwoForces)
{
  const auto packing = packings::touching(path({tilted(0.), tilted(0.)}), same);
  const dem::Mat3 stress =
      dem::particle_stress(packing.particles, packing.network)[1];
  const double expected =
      3. * 2. * radius / (4. / 3. * std::numbers::pi * std::pow(radius, 3));
  EXPECT_NEAR(stress(2, 2), expected, 1e-12 * expected);
  EXPECT_NEAR(stress.norm(), expected, 1e-12 * expected);
}

TEST(ForceChains, ALoadedColumnIsOne)
{
  // Six weaker columns round a strong one, touching it without force.
  std::vector<dem::Vec3> centres = packings::simple_cubic(3);
  auto packing = packings::touching(centres, same);
  for (dem::PairContact &contact : packing.network.pairs)
  {
    const auto &at =
        packing.particles.position(static_cast<std::size_t>(contact.a));
    const bool is_middle = std::abs(at.x() - 3. * radius) < 1e-9 &&
                           std::abs(at.y() - 3. * radius) < 1e-9;
    if (std::abs(contact.normal.z()) < 0.5)
      contact.force *= 0.01;
    else if (is_middle)
      contact.force *= 10.;
  }
  // The ends bear on platens.
  for (const double z : {0., 6. * radius})
    packing.network.walls.push_back({z == 0. ? 4 : 22,
                                     dem::Vec3(3. * radius, 3. * radius, z),
                                     dem::Vec3(0., 0., z == 0. ? 30. : -30.)});
  const dem::ForceChains chains = chains_of(packing);
  EXPECT_EQ(chains.n_chains, 1);
  EXPECT_DOUBLE_EQ(chains.mean_length, 3.);
  EXPECT_DOUBLE_EQ(chains.share, 3. / 27.);
}

TEST(ForceChains, NeedThreeParticlesAboveTheMean)
{
  // Two columns of two and of four particles, and idle ones that lower the
  // mean.
  auto one = path({tilted(0.), tilted(0.), tilted(0.)});
  one.emplace_back(0.1, 0., 0.);
  one.emplace_back(0.1, 0., 2. * radius);
  one.emplace_back(0.3, 0., 0.);
  one.emplace_back(0.3, 0., 2. * radius);
  auto packing = packings::touching(one, same);
  // Without supports the ends bear half of what the middle does.
  packing.network.walls.push_back(
      {0, dem::Vec3(0., 0., -radius), dem::Vec3(0., 0., 3.)});
  packing.network.walls.push_back(
      {3, dem::Vec3(0., 0., 7. * radius), dem::Vec3(0., 0., -3.)});
  const dem::ForceChains chains = chains_of(packing);
  EXPECT_EQ(chains.n_chains, 1);
  EXPECT_DOUBLE_EQ(chains.mean_length, 4.);
  EXPECT_DOUBLE_EQ(chains.share, 4. / 8.);
}

// Every particle is pressed along z; the contact in the middle leans.
TEST(ForceChains, EndWhereTheContactLeansMoreThan45Degrees)
{
  for (const double lean : {44., 46.})
  {
    auto centres =
        path({tilted(0.), tilted(0.), tilted(lean), tilted(0.), tilted(0.)});
    centres.emplace_back(1., 0., 0.); // bears nothing to speak of
    auto packing = packings::touching(centres, same);
    for (std::int32_t k = 0; k < 6; ++k)
      for (const double side : {-1., 1.})
        packing.network.walls.push_back(
            {k,
             packing.particles.position(static_cast<std::size_t>(k)) +
                 side * dem::Vec3(0., 0., radius),
             dem::Vec3(0., 0., -side * 1e3)});
    packing.network.walls.push_back(
        {6, packing.particles.position(6) + dem::Vec3(0., 0., radius),
         dem::Vec3(0., 0., -1.)});
    // The four in the middle differ little from the two at the ends: lower the
    // mean with the idle one.
    const dem::ForceChains chains = chains_of(packing);
    EXPECT_EQ(chains.n_chains, lean < 45. ? 1 : 2) << lean;
    EXPECT_DOUBLE_EQ(chains.mean_length, lean < 45. ? 6. : 3.) << lean;
  }
}

// Three spheres pressed between two planes, one of them shoved aside.
TEST(NetworkContacts, AreThoseOfTheEngine)
{
  dem::EngineParameters parameters = support::bare_parameters();
  parameters.particle.friction = 0.3;
  dem::Engine engine(parameters);
  const double overlap = 1e-5;
  for (int k = 0; k < 3; ++k)
    engine.add_particle(dem::make_sphere(radius),
                        {0., 0., radius + k * (2. * radius - overlap)},
                        dem::Quaternion::Identity());
  dem::add_plane(engine, dem::Vec3(0., 0., overlap), dem::Vec3::UnitZ());
  dem::add_plane(engine, dem::Vec3(0., 0., 6. * radius - 3. * overlap),
                 -dem::Vec3::UnitZ());
  engine.particles().velocity(2) = dem::Vec3(1., 0., 0.);
  engine.advance(1e-7);
  const dem::Network network = dem::contact_network_of(engine);
  ASSERT_EQ(network.pairs.size(), 2u);
  ASSERT_EQ(network.walls.size(), 2u);
  EXPECT_FALSE(network.pairs[0].is_sliding);
  EXPECT_FALSE(network.pairs[1].is_sliding);
  EXPECT_NEAR(network.pairs[0].point.z(), 2. * radius - 0.5 * overlap, 1e-9);
  for (int k = 0; k < 500; ++k) // before it rolls
    engine.advance(1e-7);
  const dem::Network later = dem::contact_network_of(engine);
  ASSERT_EQ(later.pairs.size(), 2u);
  EXPECT_TRUE(later.pairs[1].is_sliding);
  EXPECT_DOUBLE_EQ(dem::sliding_fraction(later.pairs),
                   later.pairs[0].is_sliding ? 1. : 0.5);
  // What the particles feel is what the network has.
  dem::Vec3 sum = -later.pairs[1].force;
  for (const dem::WallContact &wall : later.walls)
    if (wall.particle == 2)
      sum += wall.force;
  EXPECT_LT((sum - engine.particles().load[2].force).norm(), 1e-6 * sum.norm());
}
