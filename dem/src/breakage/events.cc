#include "../contact/surfaces.h"

#include <dem/breakage/events.h>
#include <dem/breakage/update.h>

#include <algorithm>
#include <tuple>
#include <utility>

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
         : kind == 2 ? contacts.on_facets
                     : contacts.on_drum;
}

const SideCurvature &curvature_of(const ContactBatch &batch, std::size_t k,
                                  bool is_side_a)
{
  return (is_side_a ? batch.side_a : batch.side_b).curvature[k];
}

double energy_ratio(const ContactBatch &batch, std::size_t k, bool is_side_a,
                    const BreakageParameters &breakage)
{
  return batch.history(k).normal_energy /
         (breakage.fracture_energy *
          cap_of(batch.overlap[k], curvature_of(batch, k, is_side_a).gaussian())
              .area);
}

/// What the loops asked for; it is asked for once.
std::vector<Request> collect(ContactSet &contacts,
                             const BreakageParameters &breakage)
{
  std::vector<Request> requests;
  for (int kind = 0; kind < n_contact_kinds; ++kind)
  {
    ContactBatch &batch = batch_of(contacts, kind);
    for (std::size_t k = 0; batch.layout.has_damage && k < batch.size(); ++k)
    {
      const int event = std::exchange(batch.event[k], std::uint8_t{0});
      if (event == 0)
        continue;
      bool is_side_a = event & 1;
      if (event == 3)
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

/// Touching contacts of the stone, in order of kind and number; its surface is
/// forgotten at all of its contacts.
std::vector<Place> forget_surface(ContactSet &contacts, std::int32_t stone)
{
  std::vector<Place> found;
  const auto forget = [&](int kind, std::size_t k, bool is_a)
  {
    ContactBatch &batch = batch_of(contacts, kind);
    forget_side(batch, k, is_a);
    if (batch.is_touching(k))
      found.push_back({kind, k});
  };
  for (std::size_t k = 0; k < contacts.pairs.size(); ++k)
    if (contacts.pairs.b[k] == stone)
      forget(0, k, false);
  for (int kind = 0; kind < n_contact_kinds; ++kind)
  {
    const ContactBatch &batch = batch_of(contacts, kind);
    const auto begin = batch.a.begin(),
               end = begin + static_cast<std::ptrdiff_t>(batch.size());
    const auto [first, last] = std::equal_range(begin, end, stone);
    for (auto entry = first; entry != last; ++entry)
      forget(kind, static_cast<std::size_t>(entry - begin), true);
  }
  return found;
}

/// Evaluates a contact anew; returns the energy that it gave up [J].
double reset(const ForceContext &context, ContactSet &contacts,
             const Place &place)
{
  ContactBatch &batch = batch_of(contacts, place.kind);
  const std::size_t k = place.contact;
  const Walls &walls = place.kind == 1   ? contacts.planes
                       : place.kind == 2 ? contacts.facets
                                         : contacts.drum;
  const double released = place.kind == 0
                              ? reset_pair(context, batch, k)
                              : reset_wall(context, walls, batch, k);
  if (batch.layout.has_damage && !batch.is_touching(k))
  {
    batch.factor_a[k] = 0.;
    if (batch.layout.has_partners)
      batch.factor_b[k] = 0.;
  }
  return released;
}

double &factor_of(ContactBatch &batch, const Request &request)
{
  return (request.is_side_a ? batch.factor_a : batch.factor_b)[request.contact];
}

/// Mode in which the side asks to break now, with earlier events done.
BreakageMode mode_now(ContactBatch &batch, const Request &request,
                      const BreakageParameters &breakage)
{
  if (!batch.is_touching(request.contact))
    return BreakageMode::none;
  if ((request.is_side_a ? batch.corner_a : batch.corner_b)[request.contact] <=
      0.f)
    return BreakageMode::none;
  return mode_of(
      {factor_of(batch, request),
       energy_ratio(batch, request.contact, request.is_side_a, breakage)});
}

std::int64_t other_of(const Particles &particles, const ContactBatch &batch,
                      const Request &request)
{
  if (request.kind >= 2)
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
  const std::size_t k = request.contact;
  const Triple<double> direction =
      (request.is_side_a ? batch.side_a : batch.side_b).direction[k];
  Spall spall;
  spall.direction = Vec3(direction.x, direction.y, direction.z).normalized();
  spall.overlap = batch.overlap[k];
  spall.gaussian_curvature =
      curvature_of(batch, k, request.is_side_a).gaussian();
  spall.volume = cap_of(spall.overlap, spall.gaussian_curvature).volume;
  return spall;
}

/// The new body takes the place of the old one; returns the kinetic energy of
/// what left.
double replace_body(const ForceContext &context, Particles &particles,
                    std::size_t i, const Body &body)
{
  const double before = particles.kinetic_energy(i);
  particles.body[i] = body;
  particles.update_mass(i, context.parameters.stone.density);
  if (particles.radius(i) < context.parameters.breakage.min_ball_radius)
    particles.is_breakable[i] = 0;
  return before - particles.kinetic_energy(i);
}
} // namespace

int break_stones(const ForceContext &context, Particles &particles,
                 ContactSet &contacts, double time,
                 std::vector<BreakageEvent> &events)
{
  const BreakageParameters &breakage = context.parameters.breakage;
  const SphereQuadrature &rule = sphere_rule(breakage.quadrature_rings);
  int n_refused = 0;
  for (const Request &request : collect(contacts, breakage))
  {
    ContactBatch &batch = batch_of(contacts, request.kind);
    const std::size_t k = request.contact;
    const auto i = static_cast<std::size_t>(request.stone);
    const BreakageMode mode = mode_now(batch, request, breakage);
    if (mode == BreakageMode::none || !particles.is_breakable[i])
      continue;
    double &factor = factor_of(batch, request);
    factor = factor_after(mode, factor);
    const Spall spall = spall_at(batch, request);
    const SpallResult result =
        apply_spall(particles.body[i], spall, breakage.kernel_floor, rule);
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
    event.force_before = batch.normal_force[k];
    event.overlap = spall.overlap;
    event.elastic_energy = batch.history(k).normal_energy;
    event.fracture_energy =
        breakage.fracture_energy *
        cap_of(spall.overlap, spall.gaussian_curvature).area;
    event.removed_volume = result.removed_volume;
    event.width = result.width;
    event.depth = result.depth;
    particles.travelled[i] += result.depth;
    event.kinetic_energy = replace_body(context, particles, i, result.body);
    event.ball_radius = particles.radius(i);
    for (const Place &place : forget_surface(contacts, request.stone))
      event.released_energy += reset(context, contacts, place);
    event.force_after = batch.normal_force[k];
    events.push_back(event);
  }
  return n_refused;
}
} // namespace dem
