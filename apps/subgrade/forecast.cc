#include "run/forecast.h"

#include "subgrade/subgrade.h"

#include <dem/integrate/contact_springs.h>
#include <dem/packing/insertion.h>

#include <cstdio>

namespace spall
{
namespace
{
/// One step of the stones where they lie packed, at about their solid
/// fraction on a grid [s].
double packed_cost(const Case &parameters)
{
  StoneBox box = make_stone_box(parameters);
  const LayerParameters &l = parameters.subgrade.layer;
  dem::Random random(static_cast<std::uint64_t>(l.seed));
  double volume = 0.;
  std::vector<dem::Body> stones;
  for (const auto &layer : box.layers)
    for (const dem::Body &stone : layer)
    {
      stones.push_back(stone);
      volume += stone.volume;
    }
  const dem::Vec3 half(0.5 * l.length, 0.5 * l.width, 0.);
  const double height =
      volume / (l.length * l.width * l.initial_solid_fraction);
  const auto places = dem::insert_stones(
      stones, {-half, half + height * dem::Vec3::UnitZ()}, random);
  box.engine->add_plane(dem::Vec3::Zero(), dem::Vec3::UnitZ());
  for (std::size_t i = 0; i < stones.size(); ++i)
  {
    dem::Vec3 at = places[i].position;
    at.z() *= l.initial_solid_fraction / l.solid_fraction;
    box.engine->add_stone(stones[i], at, places[i].orientation);
  }
  return still_step_cost(*box.engine, parameters.threads);
}

/// One window of the ground [s].
double window_cost(coupling::Body &body, double window)
{
  const coupling::Field load(body.motion().position.size(),
                             dem::Vec3(0., 0., -1.));
  const auto advance = [&] { body.advance(load, window); };
  advance(); // the first one factors
  const Stopwatch spent;
  constexpr int n = 20;
  for (int k = 0; k < n; ++k)
    advance();
  return spent.seconds() / n;
}
} // namespace

/// The ground, which is held while stones are placed.
double Subgrade::unseen_cost()
{
  const double window = window_of(parameters, time_step());
  // A pass predicts and corrects; with every_step it is done once.
  const int passes =
      joined->rule() == coupling::ExchangeRule::every_step ? 1 : 2;
  return passes * window_cost(*ground, window) * time_step() / window;
}

void Subgrade::print_forecast()
{
  std::printf("in a corner      %.4g s (the same stone on three walls)\n",
              dem::corner_step(engine().parameters(), scene.all));
  std::printf("subgrade         %zu cells, %zu nodes, %s\n", mesh_size.first,
              mesh_size.second,
              solid ? "full" : "condensed on the nodes of its top");
  std::printf("loading          %.4g s of pulses, impulse %.4g N s, then %.4g "
              "s of rest\n",
              pulses.duration(), pulses.impulse(),
              parameters.subgrade.pulse.rest);
  const double window = window_of(parameters, time_step());
  const double ground_cost = unseen_cost() * window / time_step();
  const double stone_cost = packed_cost(parameters);
  const double steps = duration() / time_step();
  std::printf("predicted time   %.3g s for %.4g steps of the loading (%.3g ms "
              "each, and %.3g ms a window), about %.3g s for each second of "
              "pouring and placing before\n",
              steps * stone_cost + duration() / window * ground_cost, steps,
              1e3 * stone_cost, 1e3 * ground_cost, stone_cost / time_step());
}
} // namespace spall
