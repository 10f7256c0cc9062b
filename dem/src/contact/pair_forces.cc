#include "touch.h"

namespace dem
{
namespace
{
/// Marks prefactors as out of date; more than any tolerance [rad].
constexpr double not_mixed = 10.;

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

/// Where the force of a contact acts, from both centres.
struct Levers
{
  Vec3 a = Vec3::Zero(), b = Vec3::Zero(); ///< [m]
};

/// Overlap, levers and relative motion of two stones, along the branch. Returns
/// the gap between them, at least zero, or -1 where they touch [m].
double locate(const ForceContext &context, ContactBatch &batch, std::size_t k,
              ContactMotion &motion, Levers &levers)
{
  const Particles &particles = context.particles;
  const std::int32_t a = batch.a[k], b = batch.b[k];
  const std::size_t i = row_of(a), j = row_of(b);
  const Vec3 branch = particles.position[j] - particles.position[i];
  const double distance = branch.norm();
  const double gap = distance - particles.body[i].circumscribed_radius -
                     particles.body[j].circumscribed_radius;
  if (gap >= 0. || distance <= 0.)
    return std::max(gap, 0.);
  const Vec3 n = branch / distance;
  const ContactGeometry geometry = context.parameters.geometry.geometry;
  bool is_renewed = false;
  const double r_a =
      reach_of(context, a, n, geometry, batch.side_a[k], is_renewed);
  const double r_b =
      reach_of(context, b, -n, geometry, batch.side_b[k], is_renewed);
  if (is_renewed)
    batch.twist[k] = not_mixed;
  motion.overlap = r_a + r_b - distance;
  if (motion.overlap <= 0.)
    return -motion.overlap;
  motion.normal = batch.normal[k] = n;
  levers.a = (r_a - 0.5 * motion.overlap) * n;
  levers.b = (0.5 * motion.overlap - r_b) * n;
  motion.velocity = motion.velocity_before =
      velocity_at(particles, b, levers.b) - velocity_at(particles, a, levers.a);
  motion.spin = particles.spin[j] - particles.spin[i];
  motion.reduced_mass = particles.mass[i] * particles.mass[j] /
                        (particles.mass[i] + particles.mass[j]);
  motion.rolling_radius = r_a * r_b / (r_a + r_b);
  return -1.;
}

/// One step of contact k. Returns false while it is open.
bool update_pair(const ForceContext &context, ContactBatch &batch,
                 std::size_t k)
{
  ContactMotion motion;
  Levers levers;
  if (const double gap = locate(context, batch, k, motion, levers); gap >= 0.)
  {
    const auto &velocity = context.particles.velocity;
    clear_contact(context, batch, k, gap,
                  velocity[row_of(batch.b[k])] - velocity[row_of(batch.a[k])]);
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
  const ContactForce contact = advance_contact(
      motion, hertz_spring(batch.prefactors[k], motion.overlap), coefficients,
      context.time_step, batch.history[k], batch.lost[k]);
  batch.load[k].force = contact.force;
  batch.load[k].moment_a = levers.a.cross(contact.force) + contact.moment;
  batch.load[k].moment_b = -levers.b.cross(contact.force) - contact.moment;
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
    batch.event[k] = 0;
    if (batch.wake[k] > context.travelled)
      continue;
    ContactHistory &history = batch.history[k];
    const double energy_before = history.normal_energy;
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
