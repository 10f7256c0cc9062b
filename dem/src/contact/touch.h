#pragma once

#include <dem/contact/forces.h>

namespace dem
{
/// Radius of the stone towards a world direction, by the geometry in use; the
/// cached side is renewed when it no longer holds, and `is_renewed` says so.
inline double reach_of(const ForceContext &context, std::int32_t stone,
                       const Vec3 &world_direction, SurfaceSide &side,
                       bool &is_renewed)
{
  const Particles &particles = context.particles;
  const auto i = static_cast<std::size_t>(stone);
  const Body &body = particles.body[i];
  const BreakageParameters &breakage = context.parameters.breakage;
  if (!body.series)
  {
    if (!side.is_known)
    {
      side =
          evaluate_side(body, world_direction, breakage.curvature_floor_ratio);
      is_renewed = true;
    }
    return side.expansion.radius;
  }
  const Vec3 direction = particles.rotation[i].transpose() * world_direction;
  const GeometryParameters &geometry = context.parameters.geometry;
  if (is_stale(side, direction, geometry.refresh_tolerance))
  {
    side = evaluate_side(body, direction, breakage.curvature_floor_ratio);
    is_renewed = true;
  }
  return geometry.geometry == ContactGeometry::ball
             ? particles.radius[i]
             : cached_radius(side, direction);
}

/// Velocity of the material point of a stone at `lever` from its centre.
inline Vec3 velocity_at(const Particles &particles, std::int32_t stone,
                        const Vec3 &lever)
{
  const auto i = static_cast<std::size_t>(stone);
  return particles.velocity[i] + particles.spin[i].cross(lever);
}

/// Eqs. 4 and 5 for one side of contact k; true if the stone is to break.
inline bool damage_side(const ForceContext &context, std::int32_t stone,
                        const SurfaceSide &side, double energy_before,
                        const ContactHistory &history, double &factor)
{
  const BreakageParameters &breakage = context.parameters.breakage;
  if (!breakage.is_active || !side.is_corner ||
      !context.particles.is_breakable[static_cast<std::size_t>(stone)])
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

/// The open state of contact k.
inline void clear_contact(ContactBatch &batch, std::size_t k)
{
  open_contact(batch.history[k], batch.lost[k]);
  batch.load[k] = ContactLoad{};
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
                     0.};
  update(still);
  batch.lost[k] = kept;
  return before - stored();
}
} // namespace dem
