#include <dem/integrate/rotation.h>

#include <gtest/gtest.h>

#include <cmath>

// Rigid bodies that turn freely: angular momentum, energy, order, closed form.
namespace
{
dem::Vec3 momentum(const dem::Rotor &rotor)
{
  return rotor.to_world *
         rotor.moments.cwiseProduct(rotor.to_world.conjugate() * rotor.spin);
}

double energy(const dem::Rotor &rotor)
{
  return 0.5 * rotor.spin.dot(momentum(rotor));
}

dem::Rotor tumbling()
{
  return {{1., 2., 3.5},
          dem::Quaternion(0.3, -0.5, 0.7, 0.2).normalized(),
          {0.4, 2., -0.3}};
}

dem::Rotor after(dem::Rotor rotor, double time, int n_steps)
{
  for (int step = 0; step < n_steps; ++step)
    dem::turn_freely(rotor, time / n_steps);
  return rotor;
}
} // namespace

TEST(Rotation, KeepsMomentumAndBoundsTheEnergyError)
{
  const dem::Rotor start = tumbling();
  dem::Rotor rotor = start;
  double worst = 0., early = 0.;
  for (int step = 0; step < 40000; ++step)
  {
    dem::turn_freely(rotor, 0.01);
    worst = std::max(worst, std::abs(energy(rotor) / energy(start) - 1.));
    if (step == 2000)
      early = worst;
  }
  // Round-off of 2e5 rotations, all to one side: 1.1e-11.
  EXPECT_LT((momentum(rotor) - momentum(start)).norm(),
            1e-10 * momentum(start).norm());
  EXPECT_LT(worst, 1e-3);
  EXPECT_LT(worst, 1.2 * early); // it swings, it does not grow
}

TEST(Rotation, IsOfSecondOrder)
{
  const dem::Rotor exact = after(tumbling(), 2., 20000);
  const auto error = [&](int n_steps)
  {
    return exact.to_world.angularDistance(
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
  dem::Rotor top{{2., 2., 3.}, dem::Quaternion::Identity(), {0.6, 0., 1.5}};
  const dem::Vec3 axis = momentum(top).normalized();
  const double rate = momentum(top).norm() / 2., time = 3.;
  const dem::Vec3 before = dem::Vec3::UnitZ();
  const dem::Vec3 expected = Eigen::AngleAxisd(rate * time, axis) * before;
  const dem::Rotor late = after(top, time, 3000);
  // Second order: 3e-7 here; a moment wrong by 1 % turns it by 0.02.
  EXPECT_LT((late.to_world * before - expected).norm(), 1e-5);
}

TEST(Rotation, ExponentialAgreesWithItsSeries)
{
  for (const double angle : {0., 1e-8, 0.09, 0.11, 2.})
  {
    const dem::Quaternion q = dem::exponential({0., 0., angle});
    EXPECT_NEAR(q.w(), std::cos(0.5 * angle), 1e-15);
    EXPECT_NEAR(q.z(), std::sin(0.5 * angle), 1e-15);
  }
}
