#include <dem/packing/gradation.h>

#include <gtest/gtest.h>

#include <shape/test_shapes.h>

namespace
{
const dem::GradingCurve curve{{7.1e-3, 10e-3, 16e-3, 22.4e-3},
                              {0., 0.2, 0.7, 1.}};

using Shapes = std::vector<std::shared_ptr<const dem::Coefficients>>;

Shapes two_shapes()
{
  Shapes shapes;
  for (const unsigned seed : {1u, 2u})
    shapes.push_back(std::make_shared<const dem::Coefficients>(
        dem::test::random_stone(20, seed)));
  return shapes;
}

double volume_of(const std::vector<dem::Body> &stones)
{
  double sum = 0.;
  for (const dem::Body &stone : stones)
    sum += stone.volume;
  return sum;
}

/// Share of the volume in stones finer than this diameter [-].
double passing(const std::vector<dem::Body> &stones, double diameter)
{
  double sum = 0.;
  for (const dem::Body &stone : stones)
    if (2. * dem::mean_radius(stone) < diameter)
      sum += stone.volume;
  return sum / volume_of(stones);
}
} // namespace

// A class of the curve is filled to half a stone: the largest are 5.9e-6 m^3,
// 0.6 % of the volume.
TEST(Gradation, StonesFollowTheCurve)
{
  const double solid_volume = 1e-3;
  for (const Shapes &shapes : {Shapes{}, two_shapes()})
  {
    dem::Random random(3);
    const std::vector<dem::Body> stones =
        dem::draw_stones(curve, solid_volume, shapes, random);
    // Half a smallest stone is 1e-7 m^3.
    EXPECT_NEAR(volume_of(stones), solid_volume, 1.5e-7);
    for (std::size_t k = 0; k < curve.diameter.size(); ++k)
      EXPECT_NEAR(passing(stones, curve.diameter[k] * (1. + 1e-12)),
                  curve.passing[k], 0.01);
    // Straight in ln d between the points; a class is 3 % wide.
    EXPECT_NEAR(passing(stones, std::sqrt(10e-3 * 16e-3)), 0.45, 0.03);
    for (std::size_t k = 1; k < stones.size(); ++k)
      EXPECT_LE(stones[k].volume, stones[k - 1].volume);
  }
}

TEST(Gradation, EveryShapeIsUsed)
{
  const Shapes shapes = two_shapes();
  dem::Random random(3);
  int n_first = 0;
  const auto stones = dem::draw_stones(curve, 1e-3, shapes, random);
  for (const dem::Body &stone : stones)
    n_first += stone.series == shapes[0];
  // Four standard deviations of a fair coin.
  const double n = double(stones.size());
  EXPECT_NEAR(n_first, 0.5 * n, 2. * std::sqrt(n));
}

TEST(Gradation, RefusesMoreThanMemoryHolds)
{
  dem::Random random(1);
  EXPECT_THROW(dem::draw_stones(curve, 1e6, {}, random), std::invalid_argument);
}

TEST(Gradation, SeedSettlesTheStones)
{
  const Shapes shapes = two_shapes();
  const auto draw = [&](std::uint64_t seed)
  {
    dem::Random random(seed);
    return dem::draw_stones(curve, 1e-4, shapes, random);
  };
  const auto first = draw(7), again = draw(7), other = draw(8);
  ASSERT_EQ(first.size(), again.size());
  bool is_other = other.size() != first.size();
  for (std::size_t k = 0; k < first.size(); ++k)
  {
    EXPECT_EQ(first[k].volume, again[k].volume);
    EXPECT_EQ(first[k].series, again[k].series);
    is_other = is_other || first[k].volume != other[k].volume;
  }
  EXPECT_TRUE(is_other);
}

// Numbers of mt19937_64 are the same everywhere, and so are ours.
TEST(Random, UniformAndRotation)
{
  dem::Random random(1), same(1);
  dem::Vec3 sum = dem::Vec3::Zero();
  constexpr int n = 20000;
  for (int k = 0; k < n; ++k)
  {
    const double u = random.uniform();
    ASSERT_EQ(u, same.uniform());
    ASSERT_TRUE(u >= 0. && u < 1.);
    ASSERT_LT(random.below(7), 7u);
    same.below(7);
    const dem::Quaternion q = random.rotation();
    same.rotation();
    ASSERT_NEAR(q.norm(), 1., 1e-14);
    const dem::Vec3 axis = q * dem::Vec3::UnitX();
    sum += axis.cwiseAbs2();
  }
  // Mean squares 1/3 with a deviation of sqrt(4/45 / n) = 0.002.
  EXPECT_LT((sum / n - dem::Vec3::Constant(1. / 3.)).cwiseAbs().maxCoeff(),
            0.01);
}
