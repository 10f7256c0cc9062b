#include "coupled_scene.h"

#include <coupling/rigid_body.h>
#include <dem/engine_boundaries.h>

#include <gtest/gtest.h>

#include <compaction/plate.h>
#include <compaction/scene.h>
#include <complex>

// The plate of a vibratory compaction on one particle, an oscillator of two
// masses with known springs: what it presses on is its weight and the force of
// its exciter.
namespace
{
constexpr double gravity = 9.81, step = 2e-5;
constexpr double stiffness = 1e6, damping_ratio = 0.5, particle_mass = 0.1,
                 radius = 0.02;

spall::PlateParameters plate_parameters()
{
  spall::PlateParameters plate;
  plate.mass = 10.;
  plate.load = 50.;
  plate.seating_time = 0.02;
  return plate;
}

spall::VibrationParameters exciter()
{
  spall::VibrationParameters v;
  v.eccentric_mass = 0.05;
  v.eccentricity = 4e-3;
  v.frequency = 32.;
  return v;
}

struct Scene
{
  dem::Engine engine;
  coupling::Exchange exchange{coupling::ExchangeParameters{}};
  const coupling::RigidBody *plate = nullptr;
  std::size_t plane = 0;

  static dem::EngineParameters parameters()
  {
    dem::EngineParameters p = support::bare_parameters();
    p.particle.density =
        particle_mass / (4. / 3. * std::numbers::pi * radius * radius * radius);
    p.wall.normal_stiffness = stiffness;
    p.wall.normal_damping = damping_ratio;
    p.gravity = {0., 0., -gravity};
    return p;
  }

  Scene() : engine(parameters())
  {
    support::add_sphere(engine, radius, {0., 0., radius});
    dem::add_plane(engine, dem::Vec3::Zero(), dem::Vec3::UnitZ());
    plane = dem::add_plane(engine, {0., 0., 2. * radius}, -dem::Vec3::UnitZ());
    fem::PlateBodyParameters body;
    body.mass = plate_parameters().mass;
    body.centre = {0., 0., 2. * radius};
    body.moves = {false, false, true};
    body.turns = {false, false, false};
    auto lid = std::make_unique<coupling::RigidBody>(
        body, coupling::Field{body.centre},
        spall::plate_drive(plate_parameters(), exciter()));
    plate = lid.get();
    exchange.add(std::move(lid),
                 std::make_unique<coupling::PlaneAdapter>(plane), engine);
  }
  double height() const { return dem::planes(engine)[plane].point.z(); }
  double impulse() const { return dem::planes(engine)[plane].impulse.z(); }
  void advance()
  {
    exchange.advance(coupling::particles_of(engine, support::no_shapes()),
                     step);
  }
  void run_to(double time)
  {
    while (engine.time() < time - 0.5 * step)
      advance();
  }
};

/// Amplitude of the plate in the steady state, with its phase to the exciter:
/// the wall springs k and dashpots c = 2 beta sqrt(k m) in a row.
std::complex<double> steady_answer()
{
  using namespace std::complex_literals;
  const double omega = 2. * std::numbers::pi * exciter().frequency;
  const double force =
      exciter().eccentric_mass * exciter().eccentricity * omega * omega;
  const std::complex<double> spring =
      stiffness +
      1i * omega * 2. * damping_ratio * std::sqrt(stiffness * particle_mass);
  const std::complex<double> in_particle =
      spring / (2. * spring - particle_mass * omega * omega);
  return force / (spring - plate_parameters().mass * omega * omega -
                  spring * in_particle);
}
} // namespace

TEST(CompactionPlate, SwingsAsTheOscillatorDoes)
{
  Scene scene;
  // The transient has gone down by e^-30.
  const double begin = plate_parameters().seating_time + 32. / 32.;
  scene.run_to(begin);
  const double omega = 2. * std::numbers::pi * exciter().frequency;
  std::complex<double> sum;
  double mean = 0.;
  constexpr int n_periods = 16;
  const int n = static_cast<int>(std::lround(n_periods / 32. / step));
  for (int k = 0; k < n; ++k)
  {
    scene.advance();
    const double time = scene.engine.time() - plate_parameters().seating_time;
    sum += scene.height() * std::polar(2. / n, -omega * time);
    mean += scene.height() / n;
  }
  // sin(omega t) is the imaginary part: height = Im(answer e^(i omega t)).
  const std::complex<double> answer = sum * std::complex<double>(0., 1.);
  const std::complex<double> exact = steady_answer();
  std::printf("amplitude %.6e of %.6e m, phase %.5f of %.5f\n",
              std::abs(answer), std::abs(exact), std::arg(answer),
              std::arg(exact));
  // Dashpots lag by half a step: 2e-5 s 200/s / 2 of their small part; near
  // the resonance 1 % of stiffness or mass is 5 % of the amplitude.
  EXPECT_LT(std::abs(answer - exact), 2e-3 * std::abs(exact));
  const double weight =
      plate_parameters().mass * gravity + plate_parameters().load;
  EXPECT_NEAR(2. * radius - mean,
              (2. * weight + particle_mass * gravity) / stiffness,
              1e-4 * 2. * weight / stiffness);
}

// What the particles carry over whole periods is the weight, but for the
// momentum that the plate has taken up.
TEST(CompactionPlate, MeanLoadIsTheWeight)
{
  Scene scene;
  scene.run_to(plate_parameters().seating_time + 32. / 32.);
  const double before = scene.impulse(),
               start = scene.plate->plate().velocity().z();
  const double begin = scene.engine.time();
  scene.run_to(begin + 16. / 32.);
  const double time = scene.engine.time() - begin;
  const double weight =
      plate_parameters().mass * gravity + plate_parameters().load;
  const double momentum =
      plate_parameters().mass * (scene.plate->plate().velocity().z() - start);
  // Trapezoidal rule of a sine over whole periods.
  EXPECT_NEAR((scene.impulse() - before - momentum) / time, weight,
              1e-6 * weight);
  EXPECT_NEAR((scene.impulse() - before) / time, weight, 1e-4 * weight);
}

TEST(CompactionPlate, WorkOfItsDriveIsBooked)
{
  Scene scene;
  scene.run_to(plate_parameters().seating_time + 0.5);
  const coupling::BodyEnergy energy = scene.plate->energy();
  const dem::EngineEnergy e = scene.engine.energy();
  const double residual = energy.external + e.gravity_work - energy.kinetic -
                          e.kinetic - e.elastic - e.damping;
  // Second order in the step.
  EXPECT_LT(std::abs(residual), 1e-3 * e.damping);
  EXPECT_GT(e.damping, 0.01 * energy.kinetic);
}

// A room of known volume: a tube that nothing deforms, up to any height.
TEST(CompactionTube, VolumeIsThatOfThePrism)
{
  spall::Case c = spall::default_case("vibratory_compaction");
  c.container.form = spall::ContainerForm::flexible;
  c.container.elements_around = 24;
  const fem::Membrane tube = spall::make_tube(c);
  // A regular polygon of 24 sides round a circle.
  const double section = 24. * std::tan(std::numbers::pi / 24.) *
                         std::pow(0.5 * c.container.diameter, 2);
  for (const double height : {0.01, 0.0777, 0.15, 0.17})
    EXPECT_NEAR(spall::volume_below(tube, 24, height), section * height,
                1e-12 * section);
}
