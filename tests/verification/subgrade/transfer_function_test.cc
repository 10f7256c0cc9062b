#include <fem/drive.h>
#include <fem/plate.h>
#include <fem/transfer_function.h>

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

// A plate on a spring and a dashpot under a pulse, then left alone, against
// V / F = i w / (k + i w c - m w^2).
namespace
{
struct Oscillator
{
  double mass = 50., stiffness = 2e6, damping = 2e3; // 31.8 Hz, 10 %
};

/// Largest relative error of the ratio up to 80 Hz.
double worst_error(const Oscillator &built, const Oscillator &told)
{
  const fem::Drive pulse = fem::Drive::haversine({4e3, 40.});
  const double step = 2e-5, length = 1.2;
  fem::RigidPlate plate(built.mass, 0.);
  std::vector<double> time, load, speed;
  const auto n = static_cast<int>(std::lround(length / step));
  for (int k = 0; k <= n; ++k)
  {
    const double now = k * step;
    const double force = now < 1. / 40. ? pulse(now) : 0.;
    if (k > 0)
    {
      plate.begin_step(step);
      plate.end_step(force,
                     -built.stiffness * plate.height() -
                         built.damping * plate.velocity(),
                     step);
    }
    if (k % 10 == 0) // rows of a history
    {
      time.push_back(now);
      load.push_back(force);
      speed.push_back(plate.velocity());
    }
  }
  double worst = 0.;
  const auto points = fem::transfer_function({time, load, speed}, 70.);
  EXPECT_GT(points.size(), 60u);
  for (const fem::TransferPoint &point : points)
  {
    const std::complex<double> w(0., 2. * std::numbers::pi *
                                         point.frequency); // i omega
    const std::complex<double> exact =
        w / (told.stiffness + w * told.damping + w * w * told.mass);
    worst = std::max(worst, std::abs(point.ratio / exact - 1.));
  }
  return worst;
}
} // namespace

TEST(TransferFunction, PlateOnASpring)
{
  const Oscillator plate;
  // Straight lines over 0.2 ms, (w h)^2 / 12 = 6e-4 at 70 Hz, in both; the
  // dashpot is half a step late.
  EXPECT_LT(worst_error(plate, plate), 3e-3);
  Oscillator wrong = plate;
  wrong.mass *= 1.01;
  EXPECT_GT(worst_error(plate, wrong), 5e-3);
  wrong = plate;
  wrong.stiffness *= 1.01;
  EXPECT_GT(worst_error(plate, wrong), 5e-3);
  wrong = plate;
  wrong.damping *= 1.01;
  EXPECT_GT(worst_error(plate, wrong), 5e-3);
}

TEST(TransferFunction, IntegralOfAStraightLineIsExact)
{
  // int t exp(-i w t) dt over (0, 1) with uneven samples.
  const std::vector<double> time = {0., 0.13, 0.4, 1.};
  const double f = 1.7, w = 2. * std::numbers::pi * f;
  const std::complex<double> i(0., 1.);
  const std::complex<double> exact =
      std::exp(-i * w) * (i / w + 1. / (w * w)) - 1. / (w * w);
  EXPECT_LT(std::abs(fem::fourier_integral(time, time, f) - exact), 1e-14);
}
