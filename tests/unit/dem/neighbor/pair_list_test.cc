#include <dem/contact/pair_loads.h>
#include <dem/neighbor/candidates.h>

#include <gtest/gtest.h>

#include <algorithm>

namespace
{
constexpr int n_particles = 200;

dem::ParticleSystem row_of_spheres()
{
  dem::ParticleSystem particles;
  for (int k = 0; k < n_particles; ++k)
    particles.add(dem::make_sphere(1e-3), {2e-3 * k, 0., 0.},
                  dem::Quaternion::Identity(), 2700.);
  return particles;
}

/// Neighbours up to `reach` positions away.
std::vector<dem::PairKey> neighbours(int reach)
{
  std::vector<dem::PairKey> pairs;
  for (int i = 0; i < n_particles; ++i)
    for (int j = i + 1; j < std::min(i + 1 + reach, n_particles); ++j)
      pairs.emplace_back(i, j);
  return pairs;
}

/// Those with an even sum touch, each with a force of its own.
double force_of(int a, int b)
{
  return (a + b) % 2 == 0 ? 1. + a + 1000. * b : 0.;
}
} // namespace

// Found again in a batch that is not sorted, and kept apart range by range.
TEST(PairList, ContactsThatTouchComeFirstAndKeepWhatTheyCarry)
{
  const dem::ParticleSystem particles = row_of_spheres();
  dem::ContactBatch batch;
  dem::BatchLayout layout;
  layout.has_partners = true;
  dem::LostEnergy retired;
  dem::rebuild_pairs(particles, layout, neighbours(5), batch, retired);
  for (std::size_t k = 0; k < batch.size(); ++k)
  {
    batch.normal_force[k] = force_of(batch.a[k], batch.b[k]);
    batch.overlap[k] = batch.normal_force[k] > 0. ? 1e-6 : 0.;
  }
  for (int round = 0; round < 2; ++round)
    dem::rebuild_pairs(particles, layout, neighbours(5), batch, retired);
  EXPECT_EQ(retired.non_conservative_work.value(), 0.);

  const auto size = static_cast<std::size_t>(
      dem::range_size(static_cast<std::int64_t>(batch.size())));
  std::vector<dem::PairKey> all;
  std::int32_t first_before = -1;
  for (std::size_t k = 0; k < batch.size(); ++k)
  {
    all.emplace_back(batch.a[k], batch.b[k]);
    EXPECT_EQ(batch.normal_force[k], force_of(batch.a[k], batch.b[k]));
    const std::size_t first = k / size * size;
    EXPECT_GE(batch.a[k], batch.a[first]);
    if (k == first)
    {
      EXPECT_GE(batch.a[k], first_before);
      first_before = batch.a[k];
    }
    else if (k > first + 1)
    {
      EXPECT_GE(batch.is_touching(k - 1), batch.is_touching(k)) << k;
    }
  }
  std::sort(all.begin(), all.end());
  EXPECT_EQ(all, neighbours(5));

  // What is dropped gives up its springs.
  dem::rebuild_pairs(particles, layout, neighbours(3), batch, retired);
  EXPECT_EQ(batch.size(), neighbours(3).size());
  EXPECT_GT(retired.non_conservative_work.value(), 0.);
}
