#include "touch.h"

namespace dem
{
namespace
{
/// Prefactors of Hertz and Mindlin from both sides as they lie to each other.
HertzPrefactors mix_sides(const ForceContext &context,
                          const ContactBatch &batch, std::size_t k)
{
  const SurfaceSide &a = batch.side_a[k], &b = batch.side_b[k];
  const auto &rotation = context.particles.rotation;
  const Vec3 first_a =
      rotation[static_cast<std::size_t>(batch.a[k])] * a.first_direction;
  const Vec3 first_b =
      rotation[static_cast<std::size_t>(batch.b[k])] * b.first_direction;
  // The directions lie in planes a few degrees apart; compare their parts
  // across the branch.
  const Vec3 &n = batch.normal[k];
  const Vec3 flat_a = first_a - first_a.dot(n) * n;
  const Vec3 flat_b = first_b - first_b.dot(n) * n;
  const double norms = flat_a.squaredNorm() * flat_b.squaredNorm();
  const double dot = flat_a.dot(flat_b);
  PairCurvatures pair{a.first_curvature, a.second_curvature, b.first_curvature,
                      b.second_curvature, 1.};
  if (norms > 0.)
    pair.cos_2psi = 2. * dot * dot / norms - 1.;
  return elliptic_table()(context.elasticity, gap_coefficients(pair));
}

/// Overlap, levers and relative motion of two stones; false while apart.
bool locate(const ForceContext &context, ContactBatch &batch, std::size_t k,
            ContactMotion &motion, ContactLoad &lever)
{
  const Particles &particles = context.particles;
  const std::int32_t a = batch.a[k], b = batch.b[k];
  const auto i = static_cast<std::size_t>(a), j = static_cast<std::size_t>(b);
  const Vec3 branch = particles.position[j] - particles.position[i];
  const double distance = branch.norm();
  if (distance >= particles.body[i].circumscribed_radius +
                      particles.body[j].circumscribed_radius ||
      distance <= 0.)
    return false;
  motion.normal = branch / distance;
  bool is_renewed = false;
  const double r_a =
      reach_of(context, a, motion.normal, batch.side_a[k], is_renewed);
  const double r_b =
      reach_of(context, b, -motion.normal, batch.side_b[k], is_renewed);
  motion.reach = r_a + r_b;
  motion.overlap = motion.reach - distance;
  if (is_renewed)
    batch.twist[k] = 2. * context.parameters.geometry.refresh_tolerance + 1.;
  if (motion.overlap <= 0.)
    return false;
  batch.normal[k] = motion.normal;
  lever.moment_a = (r_a - 0.5 * motion.overlap) * motion.normal;
  lever.moment_b = (0.5 * motion.overlap - r_b) * motion.normal;
  motion.velocity = velocity_at(particles, b, lever.moment_b) -
                    velocity_at(particles, a, lever.moment_a);
  motion.spin = particles.spin[j] - particles.spin[i];
  motion.reduced_mass = particles.mass[i] * particles.mass[j] /
                        (particles.mass[i] + particles.mass[j]);
  motion.rolling_radius = r_a * r_b / motion.reach;
  return true;
}

/// One step of contact k. Returns false while it is open.
bool update_pair(const ForceContext &context, ContactBatch &batch,
                 std::size_t k)
{
  ContactMotion motion;
  ContactLoad lever;
  if (!locate(context, batch, k, motion, lever))
  {
    clear_contact(batch, k);
    return false;
  }
  const EngineParameters &parameters = context.parameters;
  batch.twist[k] +=
      std::abs(motion.spin.dot(motion.normal)) * context.time_step;
  if (batch.twist[k] > parameters.geometry.refresh_tolerance)
  {
    batch.prefactors[k] = mix_sides(context, batch, k);
    batch.twist[k] = 0.;
  }
  const StoneMaterial &stone = parameters.stone;
  const ContactCoefficients coefficients{stone.friction, stone.rolling_friction,
                                         stone.normal_damping,
                                         stone.shear_damping};
  const ContactForce contact =
      advance_contact(motion, hertz_spring(batch.prefactors[k], motion.overlap),
                      coefficients, batch.prefactors[k].normal,
                      context.time_step, batch.history[k], batch.lost[k]);
  batch.load[k].force = contact.force;
  batch.load[k].moment_a = lever.moment_a.cross(contact.force) + contact.moment;
  batch.load[k].moment_b =
      -lever.moment_b.cross(contact.force) - contact.moment;
  return true;
}
} // namespace

bool pair_forces(const ForceContext &context, ContactBatch &batch)
{
  const auto n = static_cast<std::int64_t>(batch.size());
  int n_events = 0;
#pragma omp parallel for schedule(static) reduction(+ : n_events)
  for (std::int64_t entry = 0; entry < n; ++entry)
  {
    const auto k = static_cast<std::size_t>(entry);
    ContactHistory &history = batch.history[k];
    const double energy_before = history.normal_energy;
    batch.event[k] = 0;
    if (!update_pair(context, batch, k))
      continue;
    const bool breaks_a = damage_side(context, batch.a[k], batch.side_a[k],
                                      energy_before, history, history.factor_a);
    const bool breaks_b = damage_side(context, batch.b[k], batch.side_b[k],
                                      energy_before, history, history.factor_b);
    batch.event[k] =
        static_cast<std::uint8_t>((breaks_a ? 1 : 0) | (breaks_b ? 2 : 0));
    n_events += batch.event[k] != 0;
  }
  return n_events > 0;
}

double reset_pair(const ForceContext &context, ContactBatch &batch,
                  std::size_t k)
{
  return reset_contact(context, batch, k,
                       [&batch, k](const ForceContext &still)
                       { update_pair(still, batch, k); });
}
} // namespace dem
