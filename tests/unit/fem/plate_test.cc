#include <fem/drive.h>
#include <fem/plate_body.h>

#include <gtest/gtest.h>

#include <cmath>
#include <sstream>

namespace
{
using Vector = Eigen::Vector3d;
constexpr double pi = M_PI;

TEST(Drive, WavesAreWhatTheyAreCalled)
{
  const fem::Drive sine = fem::Drive::sine({3., 2., 1., 0.5});
  EXPECT_DOUBLE_EQ(sine(0.2), 1.);
  EXPECT_NEAR(sine(0.5 + 0.125), 4., 1e-12);
  const fem::Drive haversine = fem::Drive::haversine({100e3, 10., 20e3, 0.});
  EXPECT_NEAR(haversine(0.05), 120e3, 1e-9);
  EXPECT_NEAR(haversine(0.1), 20e3, 1e-9);
  EXPECT_NEAR(haversine(0.025), 70e3, 1e-9);
  // 0.2 kg at 50 mm and 30 Hz: m e omega^2 = 355.3 N.
  const fem::Drive eccentric =
      fem::Drive::eccentric_mass({0.2 * 0.05, 30., 0., 0.});
  EXPECT_NEAR(eccentric(1. / 120.), 0.01 * std::pow(60. * pi, 2), 1e-9);
  EXPECT_DOUBLE_EQ(fem::Drive::constant(-9.81)(7.), -9.81);
  EXPECT_THROW(fem::Drive::sine({1., 0., 0., 0.}), std::invalid_argument);
}

TEST(Drive, TableIsLinearAndChecked)
{
  const fem::Drive drive = fem::Drive::table({0., 1., 3.}, {10., 30., -10.});
  EXPECT_DOUBLE_EQ(drive(-1.), 10.);
  EXPECT_DOUBLE_EQ(drive(0.5), 20.);
  EXPECT_DOUBLE_EQ(drive(2.), 10.);
  EXPECT_DOUBLE_EQ(drive(9.), -10.);
  EXPECT_DOUBLE_EQ(drive.integral(), 40.);
  EXPECT_THROW(fem::Drive::table({}, {}), std::invalid_argument);
  EXPECT_THROW(fem::Drive::table({0., 0.}, {1., 2.}), std::invalid_argument);
}

TEST(PlateBody, RefusesWhatNoBodyHas)
{
  fem::PlateBodyParameters p;
  p.mass = 0.;
  EXPECT_THROW(fem::PlateBody{p}, std::invalid_argument);
  p.mass = 1.;
  p.inertia = Vector(1., 1., 3.);
  EXPECT_THROW(fem::PlateBody{p}, std::invalid_argument);
  p.inertia = Vector(1., 1., 1.5);
  p.turns = {true, true, false};
  EXPECT_THROW(fem::PlateBody{p}, std::invalid_argument);
}

// Dead weight and a moment about one axis: parabolas.
TEST(PlateBody, FallsAndTurns)
{
  fem::PlateBodyParameters p;
  p.mass = 4.;
  p.inertia = fem::disc_inertia(4., 0.15, 0.02);
  p.turns = {false, false, true};
  fem::PlateBody plate(p);
  const fem::PlateLoad weight{Vector(0., 0., -4. * 9.81), Vector(0., 0., 0.3)};
  const double dt = 1e-3;
  plate.end_step(weight, {}, 0.); // the load is there from the start
  for (int k = 0; k < 1000; ++k)
  {
    plate.begin_step(dt);
    plate.end_step(weight, {}, dt);
  }
  EXPECT_NEAR(plate.centre().z(), -0.5 * 9.81, 1e-10);
  const double acceleration = 0.3 / (0.5 * 4. * 0.15 * 0.15);
  EXPECT_NEAR(plate.spin().z(), acceleration, 1e-9 * acceleration);
  const double angle = 0.5 * acceleration;
  const Vector corner = plate.moved(Vector(0.1, 0., 0.)) - plate.centre();
  EXPECT_NEAR(corner.x(), 0.1 * std::cos(angle), 1e-9);
  EXPECT_NEAR(corner.y(), 0.1 * std::sin(angle), 1e-9);
  EXPECT_NEAR(plate.velocity_at(plate.centre() + corner).dot(corner), 0., 1e-9);
  EXPECT_NEAR(plate.kinetic_energy(), plate.drive_work(),
              1e-9 * plate.drive_work());
}

/// Angle by which the axis of a thrown disc has gone round after one second.
double precession(double dt)
{
  fem::PlateBodyParameters p;
  p.mass = 2.;
  p.inertia = Vector(1., 1., 1.8);
  fem::PlateBody plate(p);
  // A push sets the angular momentum: 1.8 * 2 along the axis, 0.7 across.
  const fem::PlateLoad push{Vector::Zero(), Vector(0.7, 0., 3.6)};
  plate.end_step(push, {}, 2.);
  plate.end_step({}, {}, 0.);
  const double energy = plate.kinetic_energy();
  const auto n_steps = static_cast<int>(1. / dt + 0.5);
  for (int k = 0; k < n_steps; ++k)
  {
    plate.begin_step(dt);
    plate.end_step({}, {}, dt);
    EXPECT_NEAR(plate.kinetic_energy(), energy, 10. * dt * dt);
  }
  // Round the direction of the momentum, which stands still.
  const Vector up = Vector(0.7, 0., 3.6).normalized();
  const Vector first = up.cross(Vector::UnitZ()).normalized();
  const Vector axis = plate.orientation() * Vector::UnitZ();
  return std::atan2(axis.dot(up.cross(first)), axis.dot(first)) + 0.5 * pi;
}

// A symmetric body without moments precesses at |L| / I_1.
TEST(PlateBody, ThrownDiscPrecesses)
{
  const double exact = std::remainder(std::hypot(0.7, 3.6), 2. * pi);
  const auto error = [&](double dt)
  { return std::remainder(precession(dt) - exact, 2. * pi); };
  const double coarse = error(0.02), fine = error(0.01);
  EXPECT_NEAR(coarse / fine, 4., 0.2);
  EXPECT_LT(std::abs(fine), 1e-3);
}

/// Largest height over the last of 60 periods of a plate on a spring and a
/// dashpot under an eccentric mass.
double steady_amplitude(double frequency, double dt)
{
  fem::PlateBodyParameters p;
  p.mass = 50.;
  p.moves = {false, false, true};
  p.turns = {false, false, false};
  fem::PlateBody plate(p);
  const double stiffness = 2e6, dashpot = 2e3;
  const fem::Drive force = fem::Drive::eccentric_mass({0.1, frequency, 0., 0.});
  double largest = 0., time = 0.;
  const double end = 60. / frequency;
  while (time < end)
  {
    plate.begin_step(dt);
    time += dt;
    const double reaction =
        -stiffness * plate.centre().z() - dashpot * plate.velocity().z();
    plate.end_step({Vector(0., 0., force(time)), Vector::Zero()},
                   {Vector(0., 0., reaction), Vector::Zero()}, dt);
    if (time > end - 1. / frequency)
      largest = std::max(largest, std::abs(plate.centre().z()));
  }
  EXPECT_NEAR(plate.kinetic_energy(),
              plate.drive_work() + plate.reaction_work(),
              1e-3 * plate.drive_work());
  return largest;
}

// m_e omega^2 / |k - m omega^2 + i c omega| below, at and above resonance
// (31.8 Hz).
TEST(PlateBody, EccentricMassOnASpring)
{
  for (const double frequency : {20., 31.8, 50.})
  {
    const double omega = 2. * pi * frequency;
    const double exact = 0.1 * omega * omega /
                         std::hypot(2e6 - 50. * omega * omega, 2e3 * omega);
    EXPECT_NEAR(steady_amplitude(frequency, 2e-5), exact, 3e-3 * exact);
  }
}

// Moved by a table: the plate is where the table says, whoever moves it does
// the work, and what it touches does not matter.
TEST(PlateBody, FollowsADisplacement)
{
  fem::PlateBodyParameters p;
  p.mass = 3.;
  p.moves = {true, true, false};
  p.turns = {false, false, false};
  fem::PlateBody plate(p);
  const fem::Drive way = fem::Drive::haversine({-5e-3, 10., 0., 0.});
  const double dt = 1e-4, stiffness = 1e6;
  for (int k = 0; k < 500; ++k)
  {
    const double t = k * dt;
    plate.set_motion(Vector(0., 0., (way(t + dt) - way(t)) / dt),
                     Vector::Zero());
    plate.begin_step(dt);
    EXPECT_NEAR(plate.centre().z(), way(t + dt), 1e-15);
    plate.end_step(
        {}, {Vector(0., 0., -stiffness * plate.centre().z()), Vector::Zero()},
        dt);
  }
  const double stored = 0.5 * stiffness * 25e-6;
  EXPECT_NEAR(plate.reaction_work(), -stored, 1e-9 * stored);
  EXPECT_NEAR(plate.holder_work() + plate.reaction_work(),
              plate.kinetic_energy(), 1e-9 * stored);
}

TEST(PlateBody, WhoeverSpinsItDoesTheWork)
{
  fem::PlateBodyParameters p;
  p.inertia = Vector(1., 1.2, 1.5);
  p.turns = {false, false, false};
  fem::PlateBody plate(p);
  plate.set_motion(Vector::Zero(), Vector(0., 0., 2.));
  EXPECT_EQ(plate.kinetic_energy(), 0.);
  plate.begin_step(0.1);
  EXPECT_NEAR(plate.kinetic_energy(), 3., 1e-12);
  EXPECT_NEAR(plate.holder_work(), 3., 1e-12);
  EXPECT_NEAR(plate.moved(Vector::UnitX()).y(), std::sin(0.2), 1e-12);
}

TEST(PlateBody, ResumesBitForBit)
{
  fem::PlateBodyParameters p;
  p.inertia = Vector(1., 1.2, 1.5);
  fem::PlateBody whole(p), first(p), second(p);
  const auto push = [](fem::PlateBody &plate)
  {
    for (int k = 0; k < 10; ++k)
    {
      plate.begin_step(0.01);
      plate.end_step({Vector(1., 2., 3.), Vector(0.3, -0.2, 0.1)},
                     {-plate.centre(), Vector::Zero()}, 0.01);
    }
  };
  push(whole);
  push(first);
  std::stringstream file;
  first.save(file);
  second.load(file);
  push(whole);
  push(second);
  EXPECT_EQ(whole.centre(), second.centre());
  EXPECT_EQ(whole.orientation().coeffs(), second.orientation().coeffs());
  EXPECT_EQ(whole.reaction_work(), second.reaction_work());
}
} // namespace
