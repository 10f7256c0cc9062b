#include <dem/breakage/events.h>
#include <dem/breakage/update.h>

#include <algorithm>
#include <tuple>

namespace dem
{
namespace
{
/// A side of a contact that asks to break.
struct Request
{
  std::int32_t stone = -1;
  int kind = 0; ///< as BreakageEvent::kind
  std::size_t contact = 0;
  bool is_side_a = true;

  auto order() const { return std::tie(stone, kind, contact); }
};

/// Names one contact of the stone that broke.
struct Place
{
  int kind = 0;
  std::size_t contact = 0;
};

ContactBatch &batch_of(ContactSet &contacts, int kind)
{
  return kind == 0   ? contacts.pairs
         : kind == 1 ? contacts.on_planes
                     : contacts.on_facets;
}

double energy_ratio(const ContactBatch &batch, std::size_t k, bool is_side_a,
                    const BreakageParameters &breakage)
{
  const SurfaceSide &side = is_side_a ? batch.side_a[k] : batch.side_b[k];
  const ContactHistory &history = batch.history[k];
  return history.normal_energy /
         (breakage.fracture_energy *
          cap_of(history.overlap, side.gaussian_curvature()).area);
}

std::vector<Request> collect(ContactSet &contacts,
                             const BreakageParameters &breakage)
{
  std::vector<Request> requests;
  for (int kind = 0; kind < 3; ++kind)
  {
    const ContactBatch &batch = batch_of(contacts, kind);
    for (std::size_t k = 0; k < batch.size(); ++k)
    {
      if (batch.event[k] == 0)
        continue;
      bool is_side_a = batch.event[k] & 1;
      if (batch.event[k] == 3)
        is_side_a = energy_ratio(batch, k, true, breakage) >=
                    energy_ratio(batch, k, false, breakage);
      requests.push_back(
          {is_side_a ? batch.a[k] : batch.b[k], kind, k, is_side_a});
    }
  }
  std::sort(requests.begin(), requests.end(),
            [](const Request &a, const Request &b)
            { return a.order() < b.order(); });
  return requests;
}

/// Contacts of the stone, in order of kind and number; its cached surface
/// there is marked unknown.
std::vector<Place> forget_surface(ContactSet &contacts, std::int32_t stone)
{
  std::vector<Place> places;
  for (int kind = 0; kind < 3; ++kind)
  {
    ContactBatch &batch = batch_of(contacts, kind);
    for (std::size_t k = 0; k < batch.size(); ++k)
    {
      const bool is_a = batch.a[k] == stone;
      const bool is_b = kind == 0 && batch.b[k] == stone;
      if (is_a)
        batch.side_a[k].is_known = false;
      if (is_b)
        batch.side_b[k].is_known = false;
      if (is_a || is_b)
        batch.wake[k] = 0.;
      if ((is_a || is_b) && batch.is_touching(k))
        places.push_back({kind, k});
    }
  }
  return places;
}

double reset(const ForceContext &context, ContactSet &contacts,
             const Place &place)
{
  switch (place.kind)
  {
  case 0:
    return reset_pair(context, contacts.pairs, place.contact);
  case 1:
    return reset_plane(context, contacts.planes, contacts.on_planes,
                       place.contact);
  default:
    return reset_facet(context, contacts.surface, contacts.facets,
                       contacts.on_facets, place.contact);
  }
}

/// Mode in which the side asks to break now, with earlier events done.
BreakageMode mode_now(const ContactBatch &batch, const Request &request,
                      const BreakageParameters &breakage)
{
  if (!batch.is_touching(request.contact))
    return BreakageMode::none;
  const SurfaceSide &side = request.is_side_a ? batch.side_a[request.contact]
                                              : batch.side_b[request.contact];
  const ContactHistory &history = batch.history[request.contact];
  if (!side.is_known || !side.is_corner)
    return BreakageMode::none;
  if (energy_ratio(batch, request.contact, request.is_side_a, breakage) > 1.)
    return BreakageMode::instantaneous;
  const double factor = request.is_side_a ? history.factor_a : history.factor_b;
  return factor > 1. ? BreakageMode::cumulative : BreakageMode::none;
}

std::int64_t other_of(const Particles &particles, const ContactBatch &batch,
                      const Request &request)
{
  if (request.kind == 2)
    return -1;
  if (request.kind == 1)
    return batch.b[request.contact];
  const std::int32_t other =
      request.is_side_a ? batch.b[request.contact] : batch.a[request.contact];
  return particles.id[static_cast<std::size_t>(other)];
}

/// What the contact takes off, where the side was last evaluated.
Spall spall_at(const ContactBatch &batch, const Request &request)
{
  const SurfaceSide &side = request.is_side_a ? batch.side_a[request.contact]
                                              : batch.side_b[request.contact];
  Spall spall;
  spall.direction = side.expansion.direction;
  spall.overlap = batch.history[request.contact].overlap;
  spall.gaussian_curvature = side.gaussian_curvature();
  spall.volume = cap_of(spall.overlap, spall.gaussian_curvature).volume;
  return spall;
}

/// Kinetic energy of a stone [J].
double kinetic_energy(const Particles &particles, std::size_t i)
{
  return 0.5 * particles.mass[i] * particles.velocity[i].squaredNorm() +
         0.5 * particles.inertia[i] * particles.spin[i].squaredNorm();
}

/// The new body takes the place of the old one; returns the kinetic energy of
/// what left.
double replace_body(const ForceContext &context, Particles &particles,
                    std::size_t i, const Body &body)
{
  const double before = kinetic_energy(particles, i);
  particles.body[i] = body;
  particles.update_mass(i, context.parameters.stone.density);
  if (particles.radius[i] < context.parameters.breakage.min_ball_radius)
    particles.is_breakable[i] = 0;
  return before - kinetic_energy(particles, i);
}
} // namespace

int break_stones(const ForceContext &context, Particles &particles,
                 ContactSet &contacts, double time,
                 std::vector<BreakageEvent> &events)
{
  const BreakageParameters &breakage = context.parameters.breakage;
  int n_refused = 0;
  for (const Request &request : collect(contacts, breakage))
  {
    ContactBatch &batch = batch_of(contacts, request.kind);
    ContactHistory &history = batch.history[request.contact];
    const auto i = static_cast<std::size_t>(request.stone);
    const BreakageMode mode = mode_now(batch, request, breakage);
    if (mode == BreakageMode::none || !particles.is_breakable[i])
      continue;
    double &factor = request.is_side_a ? history.factor_a : history.factor_b;
    factor = factor_after(mode, factor);
    const Spall spall = spall_at(batch, request);
    const SpallResult result =
        apply_spall(particles.body[i], spall, breakage.kernel_floor);
    if (!result.is_accepted)
    {
      ++n_refused;
      continue;
    }
    BreakageEvent event;
    event.time = time;
    event.stone = particles.id[i];
    event.other = other_of(particles, batch, request);
    event.kind = request.kind;
    event.mode = mode;
    event.force_before = history.normal_force;
    event.overlap = spall.overlap;
    event.elastic_energy = history.normal_energy;
    event.fracture_energy =
        breakage.fracture_energy *
        cap_of(spall.overlap, spall.gaussian_curvature).area;
    event.removed_volume = result.removed_volume;
    event.width = result.width;
    event.depth = result.depth;
    event.kinetic_energy = replace_body(context, particles, i, result.body);
    event.ball_radius = particles.radius[i];
    for (const Place &place : forget_surface(contacts, request.stone))
      event.released_energy += reset(context, contacts, place);
    event.force_after = history.normal_force;
    events.push_back(event);
  }
  return n_refused;
}
} // namespace dem
