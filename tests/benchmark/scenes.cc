#include "scenes.h"

#include <dem/control/box_servo.h>
#include <dem/random.h>
#include <dem/shape/quadrature.h>

#include <cmath>
#include <numbers>

namespace benchmark_scenes
{
std::vector<dem::Vec3> directions(int n)
{
  const double golden = std::numbers::pi * (3. - std::sqrt(5.));
  std::vector<dem::Vec3> result;
  for (int k = 0; k < n; ++k)
  {
    const double z = 1. - (2. * k + 1.) / n, rho = std::sqrt(1. - z * z);
    result.emplace_back(rho * std::cos(golden * k), rho * std::sin(golden * k),
                        z);
  }
  return result;
}

dem::ParticleShape rounded_cube(double radius)
{
  // r(s) = (x^6 + y^6 + z^6)^(-1/6), projected on the harmonics by the mean
  // over evenly spread directions.
  constexpr int order = 20, n_directions = 20000;
  const auto n = static_cast<std::size_t>(dem::n_coefficients(order));
  auto series = std::make_shared<dem::Coefficients>(n, 0.);
  std::vector<double> harmonics(n);
  for (const dem::Vec3 &s : directions(n_directions))
  {
    dem::evaluate_harmonics(order, s, harmonics);
    const double r = std::pow(s.array().pow(6).sum(), -1. / 6.);
    for (std::size_t j = 0; j < n; ++j)
      (*series)[j] += 4. * std::numbers::pi / n_directions * r * harmonics[j];
  }
  return dem::make_shape(series, radius);
}

std::unique_ptr<dem::Engine> lattice(int n, ParticleSystem kind,
                                     const dem::BreakageParameters &breakage)
{
  constexpr double radius = 5e-3, overlap = 1e-5;
  constexpr int n_steps = 3;
  dem::EngineParameters parameters;
  parameters.breakage = breakage;
  parameters.geometry.usual_skin = 5e-4;
  parameters.wall.normal_stiffness = 3e5;
  parameters.wall.shear_stiffness = 3e5;
  auto engine = std::make_unique<dem::Engine>(parameters);
  const dem::ParticleShape body = kind == ParticleSystem::shapes
                                      ? rounded_cube(radius)
                                      : dem::make_sphere(radius);
  const int side = std::max(1, static_cast<int>(std::lround(
                                   std::cbrt(0.5 * static_cast<double>(n)))));
  const double nearest = 2. * radius - overlap,
               cell = 2. / std::sqrt(3.) * nearest;
  dem::Random random(1);
  for (int k = 0; k < 2 * side * side * side; ++k)
  {
    const int m = k / 2;
    const dem::Vec3 site(m % side, m / side % side, m / side / side);
    engine->add_particle(body,
                         dem::Vec3::Constant(0.5 * nearest) +
                             cell * (site + dem::Vec3::Constant(0.5 * (k % 2))),
                         kind == ParticleSystem::shapes
                             ? random.rotation()
                             : dem::Quaternion::Identity());
  }
  dem::add_box(*engine, dem::Vec3::Zero(),
               dem::Vec3::Constant(nearest + cell * (side - 0.5)));
  for (int step = 0; step < n_steps; ++step)
    engine->advance(frozen_step);
  return engine;
}
} // namespace benchmark_scenes
