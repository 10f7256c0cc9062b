#include "run/rough_packing.h"
#include "triaxial/triaxial.h"

#include <cmath>

namespace spall
{
/// The cloud is drawn together to the solid fraction that is expected, and let
/// come near to the pressure.
void Triaxial::hasten()
{
  if (now != Stage::preparation)
    return;
  const SpecimenParameters &s = parameters.specimen;
  const double shrink = std::cbrt(s.initial_solid_fraction / s.solid_fraction);
  for (dem::StoneState &stone : engine().particles().state)
    stone.position *= shrink;
  for (dem::Plane &plane : engine().planes())
    plane.point *= shrink;
  if (dem::Drum side = engine().drum(); side.is_there())
  {
    side.centre *= shrink;
    side.radius *= shrink;
    engine().set_drum(side);
  }
  relax(engine(), time_step());
  run_roughly(
      engine(), time_step(),
      [this](double step) { servo.update(engine(), step); },
      [this]
      {
        const double share = dem::box_stress(engine(), specimen.walls).mean() /
                             parameters.preparation.pressure;
        return share > 0.5 && share < 2.;
      });
  watch.look(engine(), {}, time_step());
  hand_over();
}
} // namespace spall
