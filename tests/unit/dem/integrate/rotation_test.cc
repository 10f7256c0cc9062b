#include <dem/integrate/rotation.h>

#include <gtest/gtest.h>

#include <cmath>

// Rigid bodies that turn freely: angular momentum, energy, order, closed form.
namespace
{
using Vector = dem::Triple<double>;
using Rotor = dem::Rotor<double>;

double norm(const Vector &v)
{
  return std::sqrt(dot(v, v));
}

Vector momentum(const Rotor &rotor)
{
  return rotor.to_world *
         times(rotor.moments, inverse(rotor.to_world) * rotor.spin);
}

double energy(const Rotor &rotor)
{
  return 0.5 * dot(rotor.spin, momentum(rotor));
}

Rotor tumbling()
{
  return {{1., 2., 3.5},
          normalised(dem::Turn<double>{{-0.5, 0.7, 0.2}, 0.3}),
          {0.4, 2., -0.3}};
}

Rotor after(Rotor rotor, double time, int n_steps)
{
  for (int step = 0; step < n_steps; ++step)
    turn_freely(rotor, time / n_steps);
  return rotor;
}

/// Of the rotation from one to the other [rad], small.
double angle_between(const dem::Turn<double> &p, const dem::Turn<double> &q)
{
  return 2. * norm((inverse(p) * q).vector);
}
} // namespace

TEST(Rotation, KeepsMomentumAndBoundsTheEnergyError)
{
  const Rotor start = tumbling();
  Rotor rotor = start;
  double worst = 0., early = 0.;
  for (int step = 0; step < 40000; ++step)
  {
    turn_freely(rotor, 0.01);
    worst = std::max(worst, std::abs(energy(rotor) / energy(start) - 1.));
    if (step == 2000)
      early = worst;
  }
  // Round-off of 2e5 rotations, all to one side: 1.1e-11.
  EXPECT_LT(norm(momentum(rotor) - momentum(start)),
            1e-10 * norm(momentum(start)));
  EXPECT_LT(worst, 1e-3);
  EXPECT_LT(worst, 1.2 * early); // it swings, it does not grow
}

TEST(Rotation, IsOfSecondOrder)
{
  const Rotor exact = after(tumbling(), 2., 20000);
  const auto error = [&](int n_steps)
  {
    return angle_between(exact.to_world,
                         after(tumbling(), 2., n_steps).to_world);
  };
  const double coarse = error(100), fine = error(200);
  EXPECT_GT(coarse, 1e-6);
  EXPECT_NEAR(std::log2(coarse / fine), 2., 0.05);
}

// A body with two equal moments: its axis goes round the momentum at L / I_1
// (Landau & Lifshitz, Mechanics, section 33).
TEST(Rotation, PrecessesAsASymmetricTop)
{
  const Rotor top{{2., 2., 3.}, {}, {0.6, 0., 1.5}};
  const Vector along = momentum(top);
  const double size = norm(along), time = 3., turned = size / 2. * time;
  const double s = std::sin(0.5 * turned) / size;
  const dem::Turn<double> precession{s * along, std::cos(0.5 * turned)};
  const Vector axis{0., 0., 1.};
  // Second order: 3e-7 here; a moment wrong by 1 % turns it by 0.02.
  EXPECT_LT(norm(after(top, time, 3000).to_world * axis - precession * axis),
            1e-5);
}

TEST(Rotation, ExponentialAgreesWithItsSeries)
{
  // Two terms up to 0.01 rad.
  for (const double angle : {0., 1e-8, 1e-3, 0.00999, 0.01001, 0.09, 1., 3.})
  {
    const dem::Turn<double> q = dem::exponential(Vector{0., 0., angle});
    // Terms up to the 14th power of half the angle.
    const double tolerance = 2e-16 + std::pow(0.5 * angle, 16) / 2e13;
    EXPECT_NEAR(q.number, std::cos(0.5 * angle), tolerance);
    EXPECT_NEAR(q.vector.z, std::sin(0.5 * angle), tolerance);
  }
}
