#include "coupled_scene.h"
#include "solid_scene.h"

#include <coupling/solid_body.h>
#include <dem/engine_boundaries.h>

#include <gtest/gtest.h>

#include <complex>
#include <subgrade/load.h>

// A plate with an eccentric mass on a particle on a half-space in one
// dimension: a column of soil between smooth sides, through whose lower end
// waves leave, is a dashpot rho c_p A. Two masses, two springs and that dashpot
// swing as their closed form says.
namespace
{
constexpr double gravity = 9.81, step = 2e-5;
constexpr double plate_mass = 30., particle_mass = 0.1, radius = 0.02;
constexpr double on_plate = 3e6, on_ground = 2e6; ///< springs [N/m]
constexpr double damping_ratio = 0.3;
constexpr double side = 0.2, depth = 0.5; ///< of the column [m]
const fem::SolidLayer soil{20e6, 0.3, 1800.};

spall::Case exciter()
{
  spall::Case c = spall::default_case("subgrade");
  spall::PulseParameters &p = c.subgrade.pulse;
  p.form = spall::PulseForm::eccentric_mass;
  p.eccentric_mass = 0.5;
  p.eccentricity = 3e-3;
  p.frequency = 30.;
  p.cycles = 60;
  return c;
}

double omega()
{
  return 2. * std::numbers::pi * exciter().subgrade.pulse.frequency;
}

fem::Solid column()
{
  fem::SolidParameters p;
  p.layers = {soil};
  fem::Solid solid(p, support::box({side, side, depth}, {1, 1, 20}));
  for (const auto edge : {fem::x_lower, fem::x_upper})
    solid.fix(edge, {true, false, false});
  for (const auto edge : {fem::y_lower, fem::y_upper})
    solid.fix(edge, {false, true, false});
  solid.absorb(fem::z_lower);
  return solid;
}

dem::EngineParameters particle_on_ground()
{
  dem::EngineParameters p = support::bare_parameters();
  p.particle.density =
      particle_mass / (4. / 3. * std::numbers::pi * std::pow(radius, 3));
  p.wall.normal_stiffness = on_plate;
  p.surface.normal_stiffness = on_ground;
  p.wall.normal_damping = p.surface.normal_damping = damping_ratio;
  p.gravity = {0., 0., -gravity};
  return p;
}

/// Amplitudes of plate and ground, with their phases to the exciter.
struct Answer
{
  std::complex<double> plate, ground; ///< [m]
};

/// In balance with what lies on it when the exciter starts.
struct Scene
{
  dem::Engine engine{particle_on_ground()};
  coupling::Exchange exchange{coupling::ExchangeParameters{}};
  const spall::SubgradeLoad exciting{exciter()};
  const coupling::RigidBody *plate = nullptr;
  const coupling::SolidBody *ground = nullptr;

  Scene()
  {
    constexpr double weight = plate_mass * gravity,
                     whole = weight + particle_mass * gravity;
    const dem::Vec3 middle(0.5 * side, 0.5 * side, depth);
    const double particle = radius - whole / on_ground;
    support::add_sphere(engine, radius, middle + particle * dem::Vec3::UnitZ());
    auto block = std::make_unique<coupling::SolidBody>(column(), fem::z_upper,
                                                       coupling::BodySteps{});
    block->balance(coupling::Field(4, {0., 0., -0.25 * whole}));
    ground = block.get();
    const fem::SurfaceMesh top = block->mesh();
    exchange.add(std::move(block), top, "ground", engine.parameters().surface,
                 coupling::ParticleSide::outside, engine);

    fem::PlateBodyParameters body = support::upright(plate_mass);
    body.centre =
        middle + (particle + radius - weight / on_plate) * dem::Vec3::UnitZ();
    const std::size_t plane =
        dem::add_plane(engine, body.centre, -dem::Vec3::UnitZ());
    auto lid = std::make_unique<coupling::RigidBody>(
        body, coupling::Field{body.centre},
        coupling::RigidDrive{[this](double time)
                             {
                               fem::PlateLoad load;
                               load.force.z() = -weight - exciting(time);
                               return load;
                             },
                             {}});
    plate = lid.get();
    exchange.add(std::move(lid),
                 std::make_unique<coupling::PlaneAdapter>(plane), engine);
  }

  /// Down, less where they were [m].
  Answer settled(const Scene &start) const
  {
    return {start.plate->plate().centre().z() - plate->plate().centre().z(),
            depth - ground->motion().position[0].z()};
  }
};

Answer steady_answer()
{
  using namespace std::complex_literals;
  const fem::SolidLayer &s = soil;
  const double wave = fem::pressure_wave_speed(s);
  const double w = omega();
  const spall::PulseParameters p = exciter().subgrade.pulse;
  const double force = p.eccentric_mass * p.eccentricity * w * w;
  const auto spring = [&](double stiffness)
  {
    return stiffness +
           1i * w * 2. * damping_ratio * std::sqrt(stiffness * particle_mass);
  };
  const std::complex<double> upper = spring(on_plate),
                             lower = spring(on_ground),
                             soil_below =
                                 1i * w * s.density * wave * side * side;
  // From below: what stands under the particle, then under the plate.
  const auto under_particle = lower * soil_below / (lower + soil_below);
  const auto particle = under_particle - particle_mass * w * w;
  const auto under_plate = upper * particle / (upper + particle);
  Answer answer;
  answer.plate = force / (under_plate - plate_mass * w * w);
  const auto at_particle = answer.plate * upper / (upper + particle);
  answer.ground = at_particle * lower / (lower + soil_below);
  return answer;
}
} // namespace

TEST(ExciterOnGround, SwingsAsTwoMassesOnADashpotDo)
{
  const Scene start;
  Scene scene;
  const auto particles =
      coupling::particles_of(scene.engine, support::no_shapes());
  constexpr double begin = 40. / 30.; // the transient has gone
  constexpr int n_periods = 16;
  const int n = static_cast<int>(std::lround(n_periods / 30. / step));
  while (scene.engine.time() < begin - 0.5 * step)
    scene.exchange.advance(particles, step);
  Answer answer;
  for (int k = 0; k < n; ++k)
  {
    scene.exchange.advance(particles, step);
    // sin(omega t) is the imaginary part: x = Im(answer e^(i omega t)).
    const std::complex<double> wave =
        std::polar(2. / n, -omega() * scene.engine.time()) *
        std::complex<double>(0., 1.);
    const Answer now = scene.settled(start);
    answer.plate += now.plate * wave;
    answer.ground += now.ground * wave;
  }
  const Answer exact = steady_answer();
  std::printf("plate %.5e m, %.5f rad of %.5e m, %.5f rad; ground %.5e m, "
              "%.5f rad of %.5e m, %.5f rad\n",
              std::abs(answer.plate), std::arg(answer.plate),
              std::abs(exact.plate), std::arg(exact.plate),
              std::abs(answer.ground), std::arg(answer.ground),
              std::abs(exact.ground), std::arg(exact.ground));
  // Cells of a hundred-and-sixtieth of a wave, dashpots that lag by half a
  // step; 1 % of any mass, spring, density or modulus is more.
  EXPECT_LT(std::abs(answer.plate - exact.plate), 2e-3 * std::abs(exact.plate));
  EXPECT_LT(std::abs(answer.ground - exact.ground),
            2e-3 * std::abs(exact.ground));
}
