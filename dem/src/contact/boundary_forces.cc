#include "touch.h"

namespace dem
{
namespace
{
/// A boundary as one stone meets it at one contact.
struct Wall
{
  const WallMaterial &material;
  Vec3 direction = Vec3::UnitZ();      ///< from the stone to the wall, unit [-]
  double distance = 0.;                ///< centre to wall [m]
  Vec3 velocity = Vec3::Zero();        ///< of the wall at the contact [m/s]
  Vec3 velocity_before = Vec3::Zero(); ///< where the contact was [m/s]
  double mass = std::numeric_limits<double>::infinity(); ///< effective [kg]
};

double reduced_mass(double stone, double wall)
{
  return std::isinf(wall) ? stone : stone * wall / (stone + wall);
}

/// One step of contact k of a stone with a wall. The force acts where the
/// branch meets the wall, on both sides.
void update_wall(const ForceContext &context, const Wall &wall,
                 ContactBatch &batch, std::size_t k)
{
  const Particles &particles = context.particles;
  const std::int32_t stone = batch.a[k];
  const std::size_t i = row_of(stone);
  const ContactGeometry geometry = context.parameters.geometry.wall_geometry;
  const Vec3 apart = wall.velocity_before - particles.velocity[i];
  const double gap = wall.distance - wall_bound(particles, i, geometry);
  if (gap >= 0.)
    return clear_contact(context, batch, k, gap, apart);
  ContactMotion motion;
  bool is_renewed = false;
  const double reach = reach_of(context, stone, wall.direction, geometry,
                                batch.side_a[k], is_renewed);
  motion.overlap = reach - wall.distance;
  if (motion.overlap <= 0.)
    return clear_contact(context, batch, k, -motion.overlap, apart);
  motion.normal = batch.normal[k] = wall.direction;
  const Vec3 lever = wall.distance * wall.direction;
  motion.velocity = wall.velocity - velocity_at(particles, stone, lever);
  motion.velocity_before =
      wall.velocity_before -
      velocity_at(particles, stone, wall.distance * batch.history[k].normal);
  motion.spin = -particles.spin[i];
  motion.reduced_mass = reduced_mass(particles.mass[i], wall.mass);
  motion.rolling_radius = reach;
  const ContactForce contact =
      advance_contact(motion, linear_spring(wall.material, motion.overlap),
                      coefficients_of(wall.material), context.time_step,
                      batch.history[k], batch.lost[k]);
  batch.load[k].force = contact.force;
  batch.load[k].moment_a = lever.cross(contact.force) + contact.moment;
}

/// Damage of the stone by contact k; true if it is to break.
bool damage_wall(const ForceContext &context, double energy_before,
                 ContactBatch &batch, std::size_t k)
{
  ContactHistory &history = batch.history[k];
  const bool breaks = batch.is_touching(k) &&
                      damage_side(context, batch.a[k], batch.side_a[k],
                                  energy_before, history, history.factor_a);
  batch.event[k] = breaks ? 1 : 0;
  return breaks;
}

Wall plane_wall(const ForceContext &context, const std::vector<Plane> &planes,
                const ContactBatch &batch, std::size_t k)
{
  const Plane &plane = planes[static_cast<std::size_t>(batch.b[k])];
  const Vec3 &x =
      context.particles.position[static_cast<std::size_t>(batch.a[k])];
  return {context.parameters.wall, -plane.normal,
          (x - plane.point).dot(plane.normal), plane.velocity, plane.velocity};
}

/// Velocity of the surface at one of its points [m/s].
Vec3 velocity_on(const FacetSurface &surface, const FacetSpot &spot)
{
  Vec3 velocity = Vec3::Zero();
  if (spot.triangle < 0)
    return velocity;
  const auto &corner =
      surface.triangles[static_cast<std::size_t>(spot.triangle)];
  for (std::size_t c = 0; c < 3; ++c)
    velocity +=
        spot.weight[c] * surface.velocity[static_cast<std::size_t>(corner[c])];
  return velocity;
}

/// `before`: where the contact was in the last step.
Wall facet_wall(const ForceContext &context, const FacetSurface &surface,
                const FacetTouch &touch, const FacetSpot &before)
{
  const FacetSpot spot{touch.nearest.triangle, touch.nearest.weight};
  Wall wall{context.parameters.surface, touch.direction, touch.distance,
            velocity_on(surface, spot), velocity_on(surface, before)};
  const auto &corner =
      surface.triangles[static_cast<std::size_t>(spot.triangle)];
  double compliance = 0.;
  for (std::size_t c = 0; c < 3; ++c)
    compliance += spot.weight[c] * spot.weight[c] /
                  surface.mass[static_cast<std::size_t>(corner[c])];
  if (compliance > 0.)
    wall.mass = 1. / compliance;
  return wall;
}

/// Gives each touch the slot whose last direction is nearest to its own, or a
/// free one; a slot without touch opens. Touches beyond the slots are the
/// farthest and are left out.
void assign_slots(const std::vector<FacetTouch> &touches,
                  const ContactBatch &batch, std::size_t first,
                  std::array<std::int32_t, slots_per_stone> &slot_of)
{
  constexpr double same_patch = 0.7; // cosine of 45 degrees
  std::array<bool, slots_per_stone> is_taken{};
  slot_of.fill(-1);
  const std::size_t n = std::min<std::size_t>(touches.size(), slots_per_stone);
  for (std::size_t t = 0; t < n; ++t)
  {
    double best = same_patch;
    for (std::size_t s = 0; s < slots_per_stone; ++s)
      if (!is_taken[s] && batch.is_touching(first + s) &&
          touches[t].direction.dot(batch.normal[first + s]) > best)
      {
        best = touches[t].direction.dot(batch.normal[first + s]);
        slot_of[t] = static_cast<std::int32_t>(s);
      }
    if (slot_of[t] >= 0)
      is_taken[static_cast<std::size_t>(slot_of[t])] = true;
  }
  for (int pass = 0; pass < 2; ++pass) // free slots first, then reused ones
    for (std::size_t t = 0; t < n; ++t)
      for (std::size_t s = 0; slot_of[t] < 0 && s < slots_per_stone; ++s)
        if (!is_taken[s] && (pass == 1 || !batch.is_touching(first + s)))
        {
          slot_of[t] = static_cast<std::int32_t>(s);
          is_taken[s] = true;
        }
}
/// All contacts of one stone with the surface; returns how many ask to break.
int facet_contacts_of(const ForceContext &context, const FacetSurface &surface,
                      const FacetTopology &topology,
                      FacetCandidates &candidates, std::size_t row,
                      std::vector<FacetTouch> &touches, ContactBatch &batch)
{
  if (candidates.wake[row] > context.travelled)
    return 0;
  const auto i = static_cast<std::size_t>(candidates.stone[row]);
  const double bound = wall_bound(context.particles, i,
                                  context.parameters.geometry.wall_geometry);
  // Somewhat beyond the bound, to learn how long the stone may be left alone.
  const double reach = 1.25 * bound;
  touches.clear();
  find_touches(surface, topology, candidates.triangles_of(row),
               context.particles.position[i], reach, touches);
  const double gap =
      (touches.empty() ? reach : touches.front().distance) - bound;
  candidates.wake[row] = gap > 0. ? context.travelled + gap : 0.;
  const std::size_t first = row * slots_per_stone;
  std::array<std::int32_t, slots_per_stone> slot_of;
  assign_slots(touches, batch, first, slot_of);
  std::array<bool, slots_per_stone> is_used{};
  int n_events = 0;
  for (std::size_t t = 0; t < touches.size() && t < slots_per_stone; ++t)
  {
    const std::size_t k = first + static_cast<std::size_t>(slot_of[t]);
    is_used[k - first] = true;
    const double energy_before = batch.history[k].normal_energy;
    FacetSpot &spot = candidates.spot[k];
    update_wall(context, facet_wall(context, surface, touches[t], spot), batch,
                k);
    spot = {touches[t].nearest.triangle, touches[t].nearest.weight};
    n_events += damage_wall(context, energy_before, batch, k);
  }
  for (std::size_t s = 0; s < slots_per_stone; ++s)
    if (!is_used[s])
    {
      clear_contact(context, batch, first + s, 0.,
                    velocity_on(surface, candidates.spot[first + s]) -
                        context.particles.velocity[i]);
      batch.event[first + s] = 0;
    }
  return n_events;
}
} // namespace

bool plane_forces(const ForceContext &context, const std::vector<Plane> &planes,
                  ContactBatch &batch)
{
  const auto n = static_cast<std::int64_t>(batch.size());
  int n_events = 0;
#pragma omp parallel for schedule(static) reduction(+ : n_events)
  for (std::int64_t entry = 0; entry < n; ++entry)
  {
    const auto k = static_cast<std::size_t>(entry);
    const double energy_before = batch.history[k].normal_energy;
    update_wall(context, plane_wall(context, planes, batch, k), batch, k);
    n_events += damage_wall(context, energy_before, batch, k);
  }
  return n_events > 0;
}

bool facet_forces(const ForceContext &context, const FacetSurface &surface,
                  const FacetTopology &topology, FacetCandidates &candidates,
                  ContactBatch &batch)
{
  const auto n = static_cast<std::int64_t>(candidates.stone.size());
  int n_events = 0;
#pragma omp parallel reduction(+ : n_events)
  {
    std::vector<FacetTouch> touches;
    touches.reserve(64);
#pragma omp for schedule(static)
    for (std::int64_t row = 0; row < n; ++row)
      n_events +=
          facet_contacts_of(context, surface, topology, candidates,
                            static_cast<std::size_t>(row), touches, batch);
  }
  return n_events > 0;
}

void load_surface(const FacetCandidates &candidates, const ContactBatch &batch,
                  FacetSurface &surface)
{
  std::fill(surface.load.begin(), surface.load.end(), Vec3::Zero());
  for (std::size_t k = 0; k < batch.size(); ++k)
  {
    if (!batch.is_touching(k))
      continue;
    const FacetSpot &spot = candidates.spot[k];
    const auto &corner =
        surface.triangles[static_cast<std::size_t>(spot.triangle)];
    for (std::size_t c = 0; c < 3; ++c)
      surface.load[static_cast<std::size_t>(corner[c])] -=
          spot.weight[c] * batch.load[k].force;
  }
}

double reset_plane(const ForceContext &context,
                   const std::vector<Plane> &planes, ContactBatch &batch,
                   std::size_t k)
{
  return reset_contact(
      context, batch, k,
      [&](const ForceContext &still)
      { update_wall(still, plane_wall(still, planes, batch, k), batch, k); });
}

double reset_facet(const ForceContext &context, const FacetSurface &surface,
                   const FacetCandidates &candidates, ContactBatch &batch,
                   std::size_t k)
{
  FacetTouch touch;
  touch.nearest.triangle = candidates.spot[k].triangle;
  touch.nearest.weight = candidates.spot[k].weight;
  const auto &corner =
      surface.triangles[static_cast<std::size_t>(touch.nearest.triangle)];
  Vec3 point = Vec3::Zero();
  for (std::size_t c = 0; c < 3; ++c)
    point += touch.nearest.weight[c] *
             surface.position[static_cast<std::size_t>(corner[c])];
  const Vec3 branch = point - context.particles.position[row_of(batch.a[k])];
  touch.distance = branch.norm();
  touch.direction = branch / touch.distance;
  return reset_contact(
      context, batch, k,
      [&](const ForceContext &still)
      {
        update_wall(still,
                    facet_wall(still, surface, touch, candidates.spot[k]),
                    batch, k);
      });
}
} // namespace dem
