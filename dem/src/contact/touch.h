#pragma once

#include <dem/contact/forces.h>

namespace dem
{
/// The stone in this row of the columns.
inline std::size_t row_of(std::int32_t stone)
{
  return static_cast<std::size_t>(stone);
}

/// Renews the cached side of a stone about a unit direction of its body frame.
inline void renew_side(const ForceContext &context, std::int32_t stone,
                       const Vec3 &direction, SurfaceSide &side)
{
  side = evaluate_side(context.particles.body[row_of(stone)], direction,
                       context.parameters.breakage.curvature_floor_ratio);
}

/// Radius of the stone towards a world direction, by this geometry. The
/// cached side is renewed when it no longer holds; `is_renewed` says so.
inline double reach_of(const ForceContext &context, std::int32_t stone,
                       const Vec3 &world_direction, ContactGeometry geometry,
                       SurfaceSide &side, bool &is_renewed)
{
  const std::size_t i = row_of(stone);
  const Particles &particles = context.particles;
  const bool is_sphere = !particles.body[i].series;
  const Vec3 direction = particles.rotation[i].transpose() * world_direction;
  if (is_sphere ? !side.is_known
                : is_stale(side, direction,
                           context.parameters.geometry.refresh_tolerance))
  {
    renew_side(context, stone, direction, side);
    is_renewed = true;
  }
  if (is_sphere || geometry == ContactGeometry::ball)
    return particles.radius[i];
  return cached_radius(side, direction);
}

/// Velocity of the material point of a stone at `lever` from its centre.
inline Vec3 velocity_at(const Particles &particles, std::int32_t stone,
                        const Vec3 &lever)
{
  const std::size_t i = row_of(stone);
  return particles.velocity[i] + particles.spin[i].cross(lever);
}

/// Eqs. 4 and 5 for one side of contact k; true if the stone is to break.
inline bool damage_side(const ForceContext &context, std::int32_t stone,
                        const SurfaceSide &side, double energy_before,
                        const ContactHistory &history, double &factor)
{
  const BreakageParameters &breakage = context.parameters.breakage;
  if (!breakage.is_active || !side.is_corner ||
      !context.particles.is_breakable[row_of(stone)])
    return false;
  const Cap cap = cap_of(history.overlap, side.gaussian_curvature());
  const DamageStep step =
      damage_step(factor, energy_before, history.normal_energy,
                  breakage.fracture_energy * cap.area);
  factor = step.factor;
  return step.mode != BreakageMode::none;
}

/// Coefficients of a linear wall in the form that the law takes.
inline ContactCoefficients coefficients_of(const WallMaterial &wall)
{
  return {wall.friction, wall.rolling_friction, wall.normal_damping,
          wall.shear_damping};
}

/// Contact k is open with `gap` left [m]; `velocity` of B against A [m/s].
inline void clear_contact(const ForceContext &context, ContactBatch &batch,
                          std::size_t k, double gap, const Vec3 &velocity)
{
  open_contact(batch.history[k], velocity * context.time_step, batch.lost[k]);
  batch.load[k] = ContactLoad{};
  batch.wake[k] = context.travelled + gap;
}

/// Runs one force update of contact k with no time passing and returns the
/// energy that its springs gave up [J].
template <class Update>
double reset_contact(const ForceContext &context, ContactBatch &batch,
                     std::size_t k, const Update &update)
{
  const auto stored = [&batch, k]
  {
    return batch.history[k].normal_energy + tangential_energy(batch.history[k]);
  };
  const double before = stored();
  const Dissipation kept = batch.lost[k];
  ForceContext still{context.parameters, context.elasticity, context.particles,
                     0., context.travelled};
  update(still);
  batch.lost[k] = kept;
  return before - stored();
}
} // namespace dem
