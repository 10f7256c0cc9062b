#include <dem/engine_boundaries.h>
#include <dem/measure/contact_springs.h>
#include <dem/packing/rough_packing.h>
#include <dem/parallel/distribution.h>
#include <dem/parallel/rank_sums.h>
#include <dem/stopwatch.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace dem
{
namespace
{
constexpr int n_between = 25;    // steps between two checks of the contacts
constexpr double patience = 40.; // [s]
constexpr int n_pulls = 40, n_rest_rounds = 4; // of draw_gently()
constexpr double thinner = 0.8;   // one solid fraction over the next [-]
constexpr double thinnest = 0.01; // solid fraction [-]

/// May throw std::runtime_error.
std::vector<Placement> shrunk_cloud(std::span<const ParticleShape> particles,
                                    const Room &room, double height,
                                    double shrink)
{
  const Vec3 half(0.5 * room.width_x, 0.5 * room.width_y, 0.);
  InsertionBox cloud;
  cloud.lower = -half / shrink;
  cloud.upper = (half + height * Vec3::UnitZ()) / shrink;
  cloud.is_round = room.is_round;
  if (room.container)
    cloud.is_clear = [&](const Vec3 &centre, double radius)
    {
      Vec3 point = room.floor + shrink * centre;
      point.z() -= room.floor.z();
      return room.container->holds(point, shrink * radius);
    };
  Random random(1);
  std::vector<Placement> placements =
      insert_particles(particles, cloud, random);
  for (Placement &placement : placements)
    placement.position = room.floor + shrink * placement.position;
  return placements;
}

/// Clocks of ranks differ: when the first of them is at its end, all are.
bool has_patience(const Engine &engine, const Stopwatch &spent)
{
  return !any_of_ranks(engine.distribution().ranks(),
                       spent.seconds() >= patience);
}

void run_a_little(Engine &engine, double longest_step,
                  const std::function<void(double)> &steer)
{
  engine.synchronize();
  SpringNetwork network = contact_springs(engine, 0.);
  share_springs(engine, network);
  const double step =
      std::min(longest_step, 0.5 * guaranteed_step(network).step);
  for (int k = 0; k < n_between; ++k)
  {
    steer(step);
    engine.advance_deferred(step);
  }
}
} // namespace

std::vector<Placement> dense_packing(std::span<const ParticleShape> particles,
                                     const Room &room, double height,
                                     double solid_fraction)
{
  double volume = 0.;
  for (const ParticleShape &particle : particles)
    volume += particle.volume;
  const double dense = volume / room.volume_below(height);
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

void draw_together(Engine &engine, double factor)
{
  for (ParticleState &particle : engine.particles().state)
    particle.position *= factor;
  for (Plane &plane : planes(engine))
    plane.point *= factor;
  if (find_boundary<DrumBoundary>(engine))
  {
    Drum side = drum(engine);
    side.centre *= factor;
    side.radius *= factor;
    set_drum(engine, side);
  }
  if (const PeriodicCell cell = engine.cell(); cell.is_there())
    engine.set_periodic_cell(factor * cell.centre, factor * cell.length);
}

void relax(Engine &engine, double longest_step, int n_rounds)
{
  constexpr double frozen = 1e-15; // [s]
  engine.allow_escape();
  engine.advance_deferred(frozen); // finds the contacts
  const Stopwatch spent;
  for (int round = 0; round < n_rounds && has_patience(engine, spent); ++round)
  {
    run_a_little(engine, longest_step, [](double) {});
    engine.come_to_rest();
  }
}

void draw_gently(Engine &engine, double factor, double longest_step,
                 const std::function<bool()> &is_pressing)
{
  const Stopwatch spent;
  for (int pull = 0;
       pull < n_pulls && !is_pressing() && has_patience(engine, spent); ++pull)
  {
    draw_together(engine, std::pow(factor, 1. / n_pulls));
    relax(engine, longest_step, n_rest_rounds);
  }
}

bool run_roughly(Engine &engine, double longest_step,
                 const std::function<void(double)> &steer,
                 const std::function<bool()> &is_over)
{
  const Stopwatch spent;
  bool is_there = is_over();
  while (!is_there && has_patience(engine, spent))
  {
    run_a_little(engine, longest_step, steer);
    is_there = is_over();
  }
  return is_there;
}

void press(Engine &engine, std::size_t plane, double load, double longest_step)
{
  constexpr double speed = 0.1; // [m/s]
  place_plane(engine, plane, top_of(engine, 0.) * Vec3::UnitZ());
  planes(engine)[plane].velocity = -speed * Vec3::UnitZ();
  run_roughly(
      engine, longest_step, [](double) {},
      [&] { return planes(engine)[plane].force.z() >= load; });
  planes(engine)[plane].velocity = Vec3::Zero();
  engine.come_to_rest();
}
} // namespace dem
