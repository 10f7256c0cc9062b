#include "run/rough_packing.h"

#include "run/forecast.h"

#include <dem/engine_boundaries.h>
#include <dem/measure/contact_springs.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace spall
{
namespace
{
constexpr int n_between = 25;     // steps between two looks at the contacts
constexpr double patience = 40.;  // [s]
constexpr double thinner = 0.8;   // one solid fraction over the next [-]
constexpr double thinnest = 0.01; // solid fraction [-]

/// May throw std::runtime_error.
std::vector<dem::Placement>
shrunk_cloud(std::span<const dem::ParticleShape> particles,
             const dem::Room &room, double height, double shrink)
{
  const dem::Vec3 half(0.5 * room.width_x, 0.5 * room.width_y, 0.);
  dem::InsertionBox cloud;
  cloud.lower = -half / shrink;
  cloud.upper = (half + height * dem::Vec3::UnitZ()) / shrink;
  cloud.is_round = room.is_round;
  dem::Random random(1);
  std::vector<dem::Placement> places =
      dem::insert_particles(particles, cloud, random);
  for (dem::Placement &place : places)
    place.position = room.floor + shrink * place.position;
  return places;
}

void run_a_little(dem::Engine &engine, double longest_step,
                  const std::function<void(double)> &steer)
{
  const dem::SpringNetwork network = dem::contact_springs(engine, 0.);
  const double step =
      std::min(longest_step, 0.5 * dem::guaranteed_step(network).step);
  for (int k = 0; k < n_between; ++k)
  {
    steer(step);
    engine.advance_deferred(step);
  }
}
} // namespace

std::vector<dem::Placement>
dense_packing(std::span<const dem::ParticleShape> particles,
              const dem::Room &room, double height, double solid_fraction)
{
  double volume = 0.;
  for (const dem::ParticleShape &particle : particles)
    volume += particle.volume;
  const double dense = volume / (room.section() * height);
  for (double fraction = solid_fraction;; fraction *= thinner)
    try
    {
      return shrunk_cloud(particles, room, height, std::cbrt(fraction / dense));
    }
    catch (const std::runtime_error &)
    {
      if (fraction < thinnest)
        throw;
    }
}

void relax(dem::Engine &engine, double longest_step, int n_rounds)
{
  constexpr double frozen = 1e-15; // [s]
  engine.allow_escape();
  engine.advance_deferred(frozen); // finds the contacts
  const Stopwatch spent;
  for (int round = 0; round < n_rounds && spent.seconds() < patience; ++round)
  {
    run_a_little(engine, longest_step, [](double) {});
    engine.come_to_rest();
  }
}

bool run_roughly(dem::Engine &engine, double longest_step,
                 const std::function<void(double)> &steer,
                 const std::function<bool()> &is_over)
{
  const Stopwatch spent;
  bool is_there = is_over();
  while (!is_there && spent.seconds() < patience)
  {
    run_a_little(engine, longest_step, steer);
    is_there = is_over();
  }
  return is_there;
}

void press(dem::Engine &engine, std::size_t plane, double load,
           double longest_step)
{
  constexpr double speed = 0.1; // [m/s]
  dem::place_plane(engine, plane,
                   dem::top_of(engine.particles(), 0.) * dem::Vec3::UnitZ());
  dem::planes(engine)[plane].velocity = -speed * dem::Vec3::UnitZ();
  run_roughly(
      engine, longest_step, [](double) {},
      [&] { return dem::planes(engine)[plane].force.z() >= load; });
  dem::planes(engine)[plane].velocity = dem::Vec3::Zero();
  engine.come_to_rest();
}
} // namespace spall
