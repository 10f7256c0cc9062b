#include <dem/exact_sum.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>
#include <vector>

namespace
{
const double unit = std::ldexp(1., -80);

dem::ExactSum sum_of(const std::vector<double> &terms)
{
  dem::ExactSum sum;
  for (const double term : terms)
    sum.add(term);
  return sum;
}

double value_of(const std::vector<double> &terms)
{
  return sum_of(terms).value();
}

/// Magnitudes from 1e-20 to 1e8, both signs.
std::vector<double> mixed_numbers(std::size_t n)
{
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> exponent(-20., 8.);
  std::vector<double> numbers(n);
  for (double &number : numbers)
    number = std::pow(10., exponent(random)) * (random() % 2 ? 1. : -1.);
  return numbers;
}

TEST(ExactSum, OrderOfTermsDoesNotMatter)
{
  std::vector<double> terms = mixed_numbers(100000);
  const dem::ExactSum sum = sum_of(terms);
  const double plain = std::accumulate(terms.begin(), terms.end(), 0.);
  std::mt19937_64 random(2);
  bool has_plain_changed = false;
  for (int k = 0; k < 5; ++k)
  {
    std::ranges::shuffle(terms, random);
    EXPECT_EQ(sum_of(terms), sum);
    has_plain_changed |=
        std::accumulate(terms.begin(), terms.end(), 0.) != plain;
  }
  // Otherwise these numbers would show nothing.
  EXPECT_TRUE(has_plain_changed);
}

TEST(ExactSum, AgreesWithLongDoubles)
{
  const std::vector<double> terms = mixed_numbers(100000);
  long double reference = 0.;
  for (const double term : terms)
    reference += term;
  // A sum of 1e5 terms up to 1e8 loses 2^-64 of 1e13 a term at most.
  EXPECT_NEAR(value_of(terms), static_cast<double>(reference), 1e-1);
  // Half a unit each is all that small terms may lose.
  std::vector<double> small;
  for (const double term : terms)
    small.push_back(term * 1e-12);
  reference = 0.;
  for (const double term : small)
    reference += term;
  EXPECT_NEAR(value_of(small), static_cast<double>(reference), 1e-13);
}

TEST(ExactSum, KnownValues)
{
  EXPECT_EQ(value_of({}), 0.);
  EXPECT_EQ(value_of({0., -0.}), 0.);
  EXPECT_EQ(value_of(std::vector<double>(10, 0.1)), 1.);
  EXPECT_EQ(value_of({1e14, 1., -1e14}), 1.);
  EXPECT_EQ(value_of({-3.25, 1e-3, 3.25}), 1e-3);
  const double largest = std::nextafter(std::ldexp(1., 47), 0.);
  EXPECT_EQ(value_of({largest}), largest);
  EXPECT_EQ(value_of({-largest}), -largest);
  EXPECT_EQ(value_of({-largest, largest, unit}), unit);
}

TEST(ExactSum, TermsAreRoundedToTheNearestUnit)
{
  const double above = std::nextafter(0.5, 1.), below = std::nextafter(0.5, 0.);
  for (const double sign : {1., -1.})
  {
    const auto units = [sign](double term)
    { return sign * value_of({sign * term * unit}) / unit; };
    EXPECT_EQ(units(0.5), 0.); // half to even
    EXPECT_EQ(units(1.5), 2.);
    EXPECT_EQ(units(2.5), 2.);
    EXPECT_EQ(units(above), 1.);
    EXPECT_EQ(units(below), 0.);
    EXPECT_EQ(units(std::nextafter(2.5, 3.)), 3.);
    EXPECT_EQ(units(0.25), 0.);
    EXPECT_EQ(units(1e-30), 0.);
    EXPECT_EQ(units(12345678.75), 12345679.);
  }
  EXPECT_EQ(value_of({std::numeric_limits<double>::denorm_min()}), 0.);
  EXPECT_EQ(value_of({std::numeric_limits<double>::min()}), 0.);
}

TEST(ExactSum, ValueIsRoundedToTheNearestDouble)
{
  const double large = std::ldexp(1., 40), half_step = std::ldexp(1., -13);
  EXPECT_EQ(value_of({large, half_step}), large); // half to even
  EXPECT_EQ(value_of({large, half_step, unit}), large + 2. * half_step);
  EXPECT_EQ(value_of({large, half_step, -unit}), large);
  EXPECT_EQ(value_of({-large, -half_step, -unit}), -large - 2. * half_step);
}

TEST(ExactSum, SumOfSums)
{
  const std::vector<double> terms = mixed_numbers(1000);
  const std::vector<double> first(terms.begin(), terms.begin() + 300);
  const std::vector<double> second(terms.begin() + 300, terms.end());
  dem::ExactSum sum = sum_of(second);
  sum += sum_of(first);
  EXPECT_EQ(sum, sum_of(terms));
  EXPECT_FALSE(sum == sum_of(first));
}

TEST(ExactSum, LimbsGiveTheSumBack)
{
  const double largest = std::nextafter(std::ldexp(1., 47), 0.);
  for (const double term :
       {0., 1., -1., unit, -unit, 3.7, -3.7, largest, -largest, -1e-13, 1e10})
  {
    const dem::ExactSum sum = sum_of({term});
    EXPECT_EQ(dem::ExactSum::from_limbs(sum.limbs()), sum) << term;
    for (std::size_t k = 0; k < 3; ++k)
    {
      EXPECT_GE(sum.limbs()[k], 0);
      EXPECT_LT(sum.limbs()[k], std::int64_t{1} << 32);
    }
  }
}

TEST(ExactSum, LimbsMayBeSummed)
{
  std::array<std::int64_t, 4> limbs{};
  const std::vector<double> terms = mixed_numbers(1000);
  for (const double term : terms)
    for (std::size_t k = 0; k < 4; ++k)
      limbs[k] += sum_of({term}).limbs()[k];
  EXPECT_EQ(dem::ExactSum::from_limbs(limbs), sum_of(terms));
  // As many ranks as are allowed, each with the largest entries.
  const std::int64_t n = std::int64_t{1} << 30;
  for (std::size_t k = 0; k < 4; ++k)
    limbs[k] = n * sum_of({-unit}).limbs()[k];
  EXPECT_EQ(dem::ExactSum::from_limbs(limbs).value(),
            -static_cast<double>(n) * unit);
}

TEST(ExactSum, RefusesWhatIsOutOfRange)
{
  const double limit = std::ldexp(1., 47);
  const double largest = std::nextafter(limit, 0.);
  dem::ExactSum sum = sum_of({largest});
  const dem::ExactSum before = sum;
  for (const double term : {limit, -limit, 1e300, HUGE_VAL, -HUGE_VAL,
                            std::numeric_limits<double>::quiet_NaN(), largest})
    EXPECT_THROW(sum.add(term), std::overflow_error) << term;
  EXPECT_THROW(sum += before, std::overflow_error);
  EXPECT_EQ(sum, before);
  std::array<std::int64_t, 4> limbs = before.limbs();
  for (std::int64_t &limb : limbs)
    limb *= 2;
  EXPECT_THROW(dem::ExactSum::from_limbs(limbs), std::overflow_error);
  for (std::int64_t &limb : limbs)
    limb *= -1;
  EXPECT_THROW(dem::ExactSum::from_limbs(limbs), std::overflow_error);
}
} // namespace
