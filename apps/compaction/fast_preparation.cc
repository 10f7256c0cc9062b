#include "compaction/compaction.h"

#include <dem/packing/rough_packing.h>

namespace spall
{
namespace
{
constexpr double slippery = 0.05; // friction [-]
}

double Compaction::preparation_time() const
{
  return pouring.expected_time(engine().parameters().gravity);
}

FastPreparation Compaction::fast_preparation()
{
  double preparing = 0.;
  const auto at_plate = [this] { return plate_plane().point.z(); };
  if (now.stage == Stage::filling)
  {
    pack();
    check_contacts();
    preparing = time_step();
    hand_over(at_plate());
  }
  if (!joined)
    join(at_plate());
  release(engine().time() - parameters.plate.seating_time);
  start_vibration();
  check_contacts();
  return {.step = preparing};
}

/// What the filling would come to, about.
void Compaction::pack()
{
  const std::vector<dem::ParticleShape> bodies = pouring.particles();
  const auto placements =
      dense_packing(bodies, scene.room, parameters.container.height,
                    parameters.filling.solid_fraction);
  for (std::size_t i = 0; i < bodies.size(); ++i)
    engine().add_particle(bodies[i], placements[i].position,
                          placements[i].orientation);
  relax(engine(), time_step());
  // Strokes on every layer pack denser than one press would.
  engine().set_friction(slippery);
  press(engine(), pouring.tamper(), weight(), time_step());
  engine().set_friction(parameters.particle.friction);
}
} // namespace spall
