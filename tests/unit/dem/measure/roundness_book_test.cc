#include "dem_scene.h"

#include <dem/measure/roundness_book.h>
#include <dem/shape/measures.h>

#include <gtest/gtest.h>

namespace
{
using dem::Coefficients;
using dem::Vec3;

/// A sphere with a bump of this share of its radius.
Coefficients bumpy(double share)
{
  Coefficients series(121, 0.); // order 10
  series[0] = 1.;
  series[30] = share;
  return series;
}

double roundness_of(const dem::ParticleShape &body)
{
  return dem::roundness(*body.series, dem::standard_quadrature());
}
} // namespace

// Two particles of one shape, one of another, a sphere: Eq. 30 of each, weighed
// by volume; after one has broken as if the book knew nothing.
TEST(RoundnessBook, FollowsParticlesThatBreak)
{
  const auto shape = std::make_shared<const Coefficients>(bumpy(0.02)),
             other = std::make_shared<const Coefficients>(bumpy(0.03));
  dem::ParticleSystem particles;
  for (const dem::ParticleShape &body :
       {dem::make_shape(shape, 0.01), dem::make_shape(shape, 0.012),
        dem::make_shape(other, 0.009), dem::make_sphere(0.01)})
    particles.add(body, Vec3::Zero(), dem::Quaternion::Identity(), 2700.);
  const auto expected = [&particles]
  {
    double sum = 0., weight = 0.;
    for (const dem::ParticleShape &body : particles.shape)
      if (body.series)
      {
        sum += body.volume * roundness_of(body);
        weight += body.volume;
      }
    return sum / weight;
  };
  dem::RoundnessBook book;
  const double before = book.mean(particles, *dem::one_rank());
  EXPECT_DOUBLE_EQ(before, expected());
  EXPECT_EQ(book.of(particles.shape[3]), 1.);
  Coefficients worn = dem::scaled_coefficients(particles.shape[1]);
  worn[30] *= 0.9;
  particles.shape[1] = dem::shape_of(worn);
  EXPECT_DOUBLE_EQ(book.mean(particles, *dem::one_rank()), expected());
  EXPECT_GT(book.mean(particles, *dem::one_rank()), before);
  EXPECT_EQ(shape.use_count(), 3); // here, one particle, the book
  particles.shape[0] = dem::make_sphere(0.01);
  EXPECT_DOUBLE_EQ(book.mean(particles, *dem::one_rank()), expected());
  EXPECT_EQ(shape.use_count(), 1); // forgotten: no particle has it
}

TEST(RoundnessBook, SpheresAreRound)
{
  EXPECT_EQ(dem::RoundnessBook().mean({}, *dem::one_rank()), 1.);
}
