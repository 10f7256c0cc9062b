#include "case/gravity.h"
#include "subgrade/subgrade.h"

#include <dem/engine_boundaries.h>
#include <dem/measure/assembly.h>
#include <dem/packing/rough_packing.h>

namespace spall
{
double Subgrade::preparation_time() const
{
  return pouring.expected_time(engine().parameters().gravity);
}

FastPreparation Subgrade::fast_preparation()
{
  double preparing = 0.;
  if (now.stage == Stage::pouring)
  {
    pack();
    check_contacts();
    preparing = time_step();
    set_plate_down();
  }
  if (now.stage == Stage::placing)
    start_loading();
  check_contacts();
  return {.step = preparing};
}

/// What the pouring would come to, about, as far as the plate presses on it.
void Subgrade::pack()
{
  const LayerParameters &l = parameters.subgrade.layer;
  const LoadPlateParameters &p = parameters.subgrade.plate;
  const std::vector<dem::ParticleShape> bodies = pouring.particles();
  double volume = 0.;
  for (const dem::ParticleShape &body : bodies)
    volume += body.volume;
  const double height = scene.room.height_of(volume, l.solid_fraction);
  const auto placements =
      dense_packing(bodies, scene.room, height, l.initial_solid_fraction);
  for (std::size_t i = 0; i < bodies.size(); ++i)
    engine().add_particle(bodies[i], placements[i].position,
                          placements[i].orientation);
  relax(engine(), time_step());
  press(engine(), pouring.tamper(), p.mass * gravity + p.static_load,
        time_step());
  dem::deactivate_plane(engine(), pouring.tamper());
  engine().set_friction(parameters.particle.friction);
}
} // namespace spall
