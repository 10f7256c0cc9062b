#include "case/parameter.h"
#include "errors.h"
#include "run/rest_hint.h"
#include "subgrade/subgrade.h"

namespace spall
{
/// The ground is held: nothing of it limits the steps yet.
void Subgrade::begin_pouring()
{
  if (scene.placed)
    pouring.set_first_layer(*scene.placed);
  pouring.prepare(engine());
  if (pours_by_own_steps())
    begin_steps(parameters.time.preparing(parameters.subgrade.layer.safety),
                step_limit().step);
}

/// What a layer without free positions or without rest depends on.
void Subgrade::steer_pouring(double time_step)
{
  const LayerParameters &l = parameters.subgrade.layer;
  try
  {
    pouring.steer(engine(), time_step);
  }
  catch (const dem::NoFreePosition &error)
  {
    throw RunFailure(std::string(error.what()) +
                     ": Layer/initial_solid_fraction = " +
                     number_text(l.initial_solid_fraction) +
                     " must be lower, or Layer/layers more");
  }
  catch (const dem::NoRest &error)
  {
    throw RunFailure(error.what() + rest_hint("Layer", l.max_time,
                                              l.unbalanced_ratio,
                                              l.local_damping));
  }
}

void Subgrade::pour(double time_step)
{
  steer_pouring(time_step);
  engine().advance_deferred(time_step);
  if (!pouring.is_done())
    return;
  engine().synchronize();
  say_prepared();
  set_plate_down();
}

void Subgrade::set_plate_down()
{
  if (pours_by_own_steps())
    change_steps(parameters.time, step_limit().step);
  engine().set_renewal(parameters.contact.refresh_tolerance,
                       parameters.contact.skin);
  now.placed_at = engine().time();
  build_plate(height_above(synchronized(), parameters.subgrade.plate));
  now.stage = Stage::placing;
}
} // namespace spall
