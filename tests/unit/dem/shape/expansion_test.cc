#include "solid_harmonics.h"
#include "test_shapes.h"

#include <dem/instruction_set.h>
#include <dem/shape/patch.h>

#include <gtest/gtest.h>

#include <cstring>

using namespace dem;
using namespace dem::test;

namespace
{
/// Amplitudes that fall as n^-2: rougher than any particle of data/.
std::vector<double> rough_particle(int order, unsigned seed)
{
  std::mt19937 generator(seed);
  std::normal_distribution<double> normal;
  std::vector<double> a;
  for (int n = 0; n <= order; ++n)
    for (int m = -n; m <= n; ++m)
      a.push_back(n == 0 ? 0.03 : 3e-3 * normal(generator) / (n * n));
  return a;
}

std::vector<Vec3> directions_with_poles(int n)
{
  std::vector<Vec3> directions = random_directions(n, 11);
  for (const Vec3 &s :
       {Vec3(0, 0, 1), Vec3(0, 0, -1), Vec3(1, 0, 0), Vec3(0, -1, 0),
        Vec3(1e-9, 0, 1), Vec3(0, 1e-5, -1), Vec3(1e-3, -1e-3, 1)})
    directions.push_back(s.normalized());
  return directions;
}

bool has_same_bits(const RadialExpansion &a, const RadialExpansion &b)
{
  return std::memcmp(&a.radius, &b.radius, sizeof a.radius) == 0 &&
         std::memcmp(a.gradient.data(), b.gradient.data(),
                     sizeof(double) * 3) == 0 &&
         std::memcmp(a.hessian.data(), b.hessian.data(), sizeof(double) * 9) ==
             0;
}

std::vector<RadialExpansion> expand_all(std::span<const double> a,
                                        std::span<const Vec3> s)
{
  std::vector<RadialExpansion> expansions(s.size());
  expand(a, s, expansions);
  return expansions;
}
} // namespace

// Against solid harmonics in long double, another set of polynomials. The
// demand is 1e-10 of the mean radius; a factor wrong by 1 % shows as 1e-3.
TEST(Expansion, IsThatOfSolidHarmonicsInLongDouble)
{
  for (const int order : {0, 1, 2, 3, 7, 8, 9, 15, 16, 20, 30})
  {
    const std::vector<double> a = rough_particle(order, unsigned(order));
    const double mean = a[0] * equivalent_radius_factor;
    const std::vector<Vec3> ways = directions_with_poles(40);
    const std::vector<RadialExpansion> many = expand_all(a, ways);
    for (std::size_t k = 0; k < ways.size(); ++k)
    {
      const LongExpansion exact = long_expansion(a, ways[k]);
      for (const RadialExpansion &at : {expand(a, ways[k]), many[k]})
      {
        EXPECT_NEAR(at.radius, double(exact.radius), 1e-13 * mean);
        EXPECT_LT((at.gradient - exact.gradient.cast<double>()).norm(),
                  1e-12 * mean);
        EXPECT_LT((at.hessian - exact.hessian.cast<double>()).norm(),
                  1e-10 * mean)
            << "order " << order << " at " << ways[k].transpose();
      }
    }
  }
}

// Gauss and mean curvature of x = r(s) s by det and trace of I^-1 II.
TEST(Expansion, CurvaturesAreThoseOfLongDouble)
{
  for (const int order : {8, 20, 30})
  {
    const std::vector<double> a = rough_particle(order, 5);
    const double mean = a[0] * equivalent_radius_factor;
    for (const Vec3 &s : directions_with_poles(40))
    {
      const PrincipalCurvatures at = principal_curvatures(expand(a, s));
      const LongCurvatures exact = long_curvatures(long_expansion(a, s));
      EXPECT_NEAR(at.maximum * mean, double(exact.maximum) * mean, 1e-10);
      EXPECT_NEAR(at.minimum * mean, double(exact.minimum) * mean, 1e-10);
    }
  }
}

TEST(Expansion, HasOneSetOfDigitsForAllInstructionSets)
{
  const std::vector<Vec3> ways = directions_with_poles(100);
  const InstructionSet widest = widest_instruction_set();
  for (const int order : {1, 2, 8, 12, 20, 30})
  {
    const std::vector<double> a = rough_particle(order, 3);
    use_instruction_set(InstructionSet::baseline);
    const std::vector<RadialExpansion> baseline = expand_all(a, ways);
    std::vector<RadialExpansion> single;
    for (const Vec3 &s : ways)
      single.push_back(expand(a, s));
    for (const InstructionSet set :
         {InstructionSet::avx2, InstructionSet::avx512})
    {
      if (set > widest)
        continue;
      use_instruction_set(set);
      const std::vector<RadialExpansion> many = expand_all(a, ways);
      for (std::size_t k = 0; k < ways.size(); ++k)
      {
        EXPECT_TRUE(has_same_bits(many[k], baseline[k])) << name_of(set);
        EXPECT_TRUE(has_same_bits(expand(a, ways[k]), single[k]))
            << name_of(set) << " order " << order;
      }
    }
  }
  use_instruction_set(widest);
}

TEST(Expansion, OfManyDoesNotKnowItsNeighbours)
{
  const std::vector<double> a = rough_particle(20, 4);
  const std::vector<Vec3> ways = random_directions(150, 6);
  const std::vector<RadialExpansion> many = expand_all(a, ways);
  for (const std::size_t first : {0u, 1u, 70u, 149u})
    EXPECT_TRUE(has_same_bits(
        expand_all(a, std::span(ways).subspan(first, 1))[0], many[first]));
  EXPECT_TRUE(expand_all(a, {}).empty());
}
