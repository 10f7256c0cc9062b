#include "run/forecast.h"
#include "triaxial/triaxial.h"

#include <dem/engine_boundaries.h>
#include <dem/measure/assembly.h>
#include <dem/packing/rough_packing.h>

#include <cmath>
#include <numbers>

namespace spall
{
namespace
{
/// Of true surfaces: the unbalanced force ratio that is rest enough [-].
constexpr double unrest = 0.02;
/// What particles take to come to rest over the cube root of the volume of the
/// specimen: of limestone at 30 kPa 0.8 to 1.05 [s/m]
/// (docs/theory/preparation.md).
constexpr double rest_per_metre = 0.95;
} // namespace

double Triaxial::preparation_time() const
{
  const SpecimenParameters &s = parameters.specimen;
  const bool is_box = s.form == SpecimenForm::box;
  const double length = is_box ? s.side
                               : std::cbrt(0.25 * std::numbers::pi *
                                           s.diameter * s.diameter * s.height);
  const double grown = std::cbrt(s.solid_fraction / s.initial_solid_fraction);
  // Walls on both sides.
  const double closing =
      0.5 * (grown - 1.) * length / parameters.preparation.wall_speed;
  return closing + rest_per_metre * length;
}

/// The cloud is drawn together to the solid fraction that is expected, and let
/// come near to the pressure; true surfaces no further than until they press,
/// and the walls do the rest.
FastPreparation Triaxial::fast_preparation()
{
  if (now != Stage::preparation)
    return {};
  const SpecimenParameters &s = parameters.specimen;
  const double shrink = std::cbrt(s.initial_solid_fraction / s.solid_fraction);
  const bool has_surfaces = engine().particles().follows_surfaces;
  const double target = parameters.preparation.pressure;
  const auto stress = [this] { return dem::box_stress(engine(), box).mean(); };
  const bool has_walls = !parameters.walls.empty(); // which stay
  if (has_surfaces && !has_walls)
    draw_gently(engine(), shrink, time_step(),
                [&] { return stress() >= target; });
  else if (!has_walls)
  {
    draw_together(engine(), shrink);
    relax(engine(), time_step());
  }
  FastPreparation result;
  result.is_packed = run_roughly(
      engine(), time_step(),
      [this](double length) { servo.update(engine(), length); },
      [&]
      {
        const double share = stress() / target;
        return share > 0.8 && share < 1.25 &&
               (!has_surfaces ||
                dem::unbalanced_force_ratio(synchronized()) < unrest);
      });
  is_rough = true;
  watch.update(synchronized(), {}, time_step());
  result.step = time_step();
  result.cost = time_particles(engine(), time_step());
  hand_over();
  return result;
}
} // namespace spall
