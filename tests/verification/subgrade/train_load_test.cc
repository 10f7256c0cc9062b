#include <fem/train_load.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

// A train of pulses against its own formula, the rail on its bed against the
// differential equation of the beam.
namespace
{
const fem::Train train{100e3, 2.5, 17.375, 24.775, 2, 50.};

double integral(const fem::Train &of, const fem::AxleShare &share, double from,
                double to)
{
  const auto axles = fem::axle_distances(of);
  const int n = 400000;
  const double step = (to - from) / n;
  double sum = 0.;
  for (int k = 0; k < n; ++k)
    sum += step * fem::train_load(of, axles, share, from + (k + 0.5) * step);
  return sum;
}
} // namespace

TEST(TrainLoad, AxlesPassAtTheirTimes)
{
  // Two cars by hand: bogies 17.375 m apart, cars 24.775 m.
  const std::vector<double> expected = {0.,     2.5,    17.375, 19.875,
                                        24.775, 27.275, 42.15,  44.65};
  const auto axles = fem::axle_distances(train);
  ASSERT_EQ(axles.size(), expected.size());
  for (std::size_t k = 0; k < axles.size(); ++k)
    EXPECT_NEAR(axles[k], expected[k], 1e-12);
  // A share that only a sleeper right below the axle gets peaks at x / v.
  const auto narrow = [](double x)
  { return std::max(0., 1. - std::abs(x) / 0.1); };
  for (const double x : expected)
  {
    EXPECT_NEAR(fem::train_load(train, axles, narrow, x / 50.), 100e3, 1.);
    EXPECT_NEAR(fem::train_load(train, axles, narrow, x / 50. + 1e-3), 50e3,
                1.);
  }
}

TEST(TrainLoad, ImpulseIsThatOfTheAxles)
{
  const fem::RailBed bed;
  const auto share = [&](double x) { return fem::sleeper_share(bed, x); };
  // Every axle leaves P a / v on each sleeper, whatever the rail.
  const double exact = 8 * 100e3 * 0.6 / 50.;
  EXPECT_NEAR(integral(train, share, -1., 2.), exact, 1e-5 * exact);
}

TEST(TrainLoad, RailIsABeamOnItsBed)
{
  // w = P share / (a u) with E I w'''' + u w = 0 beside the axle and
  // E I w''' = P / 2 right behind it.
  const fem::RailBed bed{6.4e6, 40e6, 0.6};
  const auto deflection = [&](double x)
  { return fem::sleeper_share(bed, x) / (bed.sleeper_spacing * 40e6); };
  const double h = 0.02;
  for (const double x : {0.3, 0.7, 1.5})
  {
    const double fourth =
        (deflection(x - 2. * h) - 4. * deflection(x - h) + 6. * deflection(x) -
         4. * deflection(x + h) + deflection(x + 2. * h)) /
        std::pow(h, 4);
    // Second-order differences: h^2 / (6 L^2) = 8e-5.
    EXPECT_NEAR(6.4e6 * fourth / (-40e6 * deflection(x)), 1., 1e-3) << x;
  }
  const double third = (-deflection(0.) + 3. * deflection(h) -
                        3. * deflection(2. * h) + deflection(3. * h)) /
                       std::pow(h, 3);
  const double next = (-deflection(h) + 3. * deflection(2. * h) -
                       3. * deflection(3. * h) + deflection(4. * h)) /
                      std::pow(h, 3);
  // At 1.5 h and 2.5 h, taken back to zero.
  EXPECT_NEAR(6.4e6 * (2.5 * third - 1.5 * next), 0.5, 2e-3);
  // All sleepers together carry the axle.
  for (const double position : {0., 0.2})
  {
    double sum = 0.;
    for (int k = -40; k <= 40; ++k)
      sum += fem::sleeper_share(bed, position + 0.6 * k);
    EXPECT_NEAR(sum, 1., 5e-3);
  }
}

TEST(TrainLoad, TableIsLinearAndRefused)
{
  const fem::ShareTable table({0., 0.6, 1.2}, {0.5, 0.25, 0.});
  EXPECT_DOUBLE_EQ(table(0.), 0.5);
  EXPECT_DOUBLE_EQ(table(-0.3), 0.375);
  EXPECT_DOUBLE_EQ(table(0.9), 0.125);
  EXPECT_DOUBLE_EQ(table(1.3), 0.);
  // Twice the two trapezia.
  EXPECT_DOUBLE_EQ(table.integral(), 0.6);
  const double exact = 8 * 100e3 * 0.6 / 50.;
  EXPECT_NEAR(integral(train, table, -1., 2.), exact, 1e-5 * exact);
  EXPECT_THROW(fem::ShareTable({0.}, {0.5}), std::invalid_argument);
  EXPECT_THROW(fem::ShareTable({0.1, 0.6}, {0.5, 0.25}), std::invalid_argument);
  fem::Train folded = train;
  folded.bogie_spacing = 2.;
  EXPECT_THROW(fem::axle_distances(folded), std::invalid_argument);
}
