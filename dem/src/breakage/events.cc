#include "../contact/surfaces.h"

#include <dem/breakage/events.h>
#include <dem/breakage/update.h>
#include <dem/exact_sum.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>
#include <utility>

namespace dem
{
namespace
{
/// A side of a contact that requests breakage.
struct Request
{
  std::int32_t particle = -1;
  int batch = 0; ///< as batch_of
  std::size_t contact = 0;
  bool is_side_a = true;
  /// By ids of the particle and of both sides (a boundary by its row), then by
  /// the direction on A: the same wherever columns and contacts stand.
  std::tuple<std::int64_t, int, std::int64_t, std::int64_t,
             std::array<Narrow, 3>>
      order;
};

/// The request of one side of contact k.
Request request_of(const ParticleSystem &particles, const ContactBatch &batch,
                   int number, std::size_t k, bool is_side_a)
{
  const auto id = [&particles](std::int32_t row)
  { return particles.id[static_cast<std::size_t>(row)]; };
  const std::int32_t particle = is_side_a ? batch.a[k] : batch.b[k];
  const TripleColumn<Narrow> &u = batch.side_a.direction;
  return {particle,
          number,
          k,
          is_side_a,
          {id(particle),
           number,
           id(batch.a[k]),
           batch.layout.has_partners ? id(batch.b[k]) : batch.b[k],
           {u.x[k], u.y[k], u.z[k]}}};
}

/// Names one contact of the particle that broke.
struct ContactIndex
{
  int batch = 0; ///< as batch_of
  std::size_t contact = 0;
};

/// Pairs, then one batch for each boundary.
int n_batches(const ContactSet &contacts)
{
  return 1 + static_cast<int>(contacts.boundaries.size());
}

Boundary &boundary_of(const ContactSet &contacts, int batch)
{
  return *contacts.boundaries[static_cast<std::size_t>(batch - 1)];
}

ContactBatch &batch_of(ContactSet &contacts, int batch)
{
  return batch == 0 ? contacts.pairs : boundary_of(contacts, batch).batch;
}

/// K_G that the caps of this side have [1/m^2].
double cap_curvature(const ContactBatch &batch, std::size_t k, bool is_side_a,
                     CapCurvature choice)
{
  if (choice == CapCurvature::own)
    return (is_side_a ? batch.side_a : batch.side_b).curvature[k].gaussian();
  // The slope of the cap alone depends on the other surface.
  const double slope = (is_side_a ? batch.corner_a : batch.corner_b)[k];
  return std::pow(cap_slope(1.) / slope, 2);
}

/// E_e of the contact as the criterion counts it [J].
double counted_energy(const ContactBatch &batch, std::size_t k,
                      const BreakageParameters &breakage)
{
  const ContactHistory<double> history = batch.history(k);
  double energy = history.normal_energy;
  if (breakage.energy == CriterionEnergy::with_shear)
    energy += shear_energy(history);
  return energy;
}

double energy_ratio(const ContactBatch &batch, std::size_t k, bool is_side_a,
                    const BreakageParameters &breakage)
{
  const double curvature =
      cap_curvature(batch, k, is_side_a, breakage.curvature);
  return counted_energy(batch, k, breakage) /
         (breakage.fracture_energy * cap_of(batch.overlap[k], curvature).area);
}

/// Bits of the sides that are to break: of both the one with the larger ratio,
/// if only one may.
int sides_of(const ContactBatch &batch, std::size_t k, int event,
             const BreakageParameters &breakage)
{
  if (event != 3 || breakage.sides == BrokenSides::both)
    return event;
  return energy_ratio(batch, k, true, breakage) >=
                 energy_ratio(batch, k, false, breakage)
             ? 1
             : 2;
}

/// Requests of the loops; each is handled once.
std::vector<Request> collect(const ParticleSystem &particles,
                             ContactSet &contacts,
                             const BreakageParameters &breakage)
{
  std::vector<Request> requests;
  for (int number = 0; number < n_batches(contacts); ++number)
  {
    ContactBatch &batch = batch_of(contacts, number);
    for (std::size_t k = 0; batch.layout.has_damage && k < batch.size(); ++k)
    {
      const int event = std::exchange(batch.event[k], std::uint8_t{0});
      if (event == 0)
        continue;
      const int sides = sides_of(batch, k, event, breakage);
      if (sides & 1)
        requests.push_back(request_of(particles, batch, number, k, true));
      if (sides & 2)
        requests.push_back(request_of(particles, batch, number, k, false));
    }
  }
  std::sort(requests.begin(), requests.end(),
            [](const Request &a, const Request &b)
            { return a.order < b.order; });
  return requests;
}

/// Touching contacts of the particle, in order of batch and number; its surface
/// is forgotten at all of its contacts.
std::vector<ContactIndex> forget_surface(ContactSet &contacts,
                                         std::int32_t particle)
{
  std::vector<ContactIndex> found;
  const auto forget = [&](int number, std::size_t k, bool is_a)
  {
    ContactBatch &batch = batch_of(contacts, number);
    forget_side(batch, k, is_a);
    if (batch.is_touching(k))
      found.push_back({number, k});
  };
  // Pairs are not sorted.
  for (const bool is_a : {false, true})
    for (std::size_t k = 0; k < contacts.pairs.size(); ++k)
      if ((is_a ? contacts.pairs.a : contacts.pairs.b)[k] == particle)
        forget(0, k, is_a);
  for (int number = 1; number < n_batches(contacts); ++number)
  {
    const ContactBatch &batch = batch_of(contacts, number);
    const auto begin = batch.a.begin(),
               end = begin + static_cast<std::ptrdiff_t>(batch.size());
    const auto [first, last] = std::equal_range(begin, end, particle);
    for (auto entry = first; entry != last; ++entry)
      forget(number, static_cast<std::size_t>(entry - begin), true);
  }
  return found;
}

/// Factors of a contact that has opened: lost, or marked for their patches. The
/// loops look at an open contact only together with others that touch.
void end_damage(ContactBatch &batch, std::size_t k, FactorMemory memory)
{
  if (batch.layout.has_reversal)
    batch.reversal[k] = 0.;
  if (memory == FactorMemory::patch)
  {
    batch.event[k] = static_cast<std::uint8_t>(batch.event[k] | 4u);
    return;
  }
  batch.factor_a[k] = 0.;
  if (batch.layout.has_partners)
    batch.factor_b[k] = 0.;
}

/// Evaluates a contact again; returns the energy that it gave up [J].
double reset(const ForceContext &context, ContactSet &contacts,
             const ContactIndex &index)
{
  ContactBatch &batch = batch_of(contacts, index.batch);
  const std::size_t k = index.contact;
  const double released =
      index.batch == 0
          ? reset_pair(context, batch, k)
          : reset_wall(context,
                       boundary_of(contacts, index.batch).walls(context), batch,
                       k);
  if (batch.layout.has_damage && !batch.is_touching(k))
    end_damage(batch, k, context.parameters.breakage.memory);
  return released;
}

double &factor_of(ContactBatch &batch, const Request &request)
{
  return (request.is_side_a ? batch.factor_a : batch.factor_b)[request.contact];
}

/// Mode of breakage of the side now, after earlier events.
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
       energy_ratio(batch, request.contact, request.is_side_a, breakage)},
      breakage.precedence);
}

/// Names the other side: BreakageEvent::kind and other.
void name_other(const ContactSet &contacts, const ParticleSystem &particles,
                const Request &request, BreakageEvent &event)
{
  if (request.batch > 0)
  {
    const Boundary &boundary = boundary_of(contacts, request.batch);
    event.kind = boundary.event_kind();
    event.other = boundary.event_other(request.contact);
    return;
  }
  const std::int32_t other =
      (request.is_side_a ? contacts.pairs.b
                         : contacts.pairs.a)[request.contact];
  event.other = particles.id[static_cast<std::size_t>(other)];
}

/// Share of overlap and energy that the particle gets: that of its compliance
/// in the compliance of both; walls are rigid [-].
double share_of(const ForceContext &context, const ContactBatch &batch,
                const Request &request)
{
  if (context.parameters.breakage.share != EnergyShare::compliance ||
      request.batch != 0)
    return 1.;
  const auto material = [&context](std::int32_t particle)
  { return context.particles.material[static_cast<std::size_t>(particle)]; };
  const std::uint8_t a = material(batch.a[request.contact]),
                     b = material(batch.b[request.contact]);
  return context.elasticity.pair(a, b).modulus /
         context.elasticity.on_plate(request.is_side_a ? a : b).modulus;
}

/// What the contact takes off, where the side was last evaluated.
Spall spall_at(const ForceContext &context, const ContactBatch &batch,
               const Request &request)
{
  const std::size_t k = request.contact;
  const Triple<double> direction =
      (request.is_side_a ? batch.side_a : batch.side_b).direction[k];
  Spall spall;
  spall.direction = Vec3(direction.x, direction.y, direction.z).normalized();
  spall.overlap = share_of(context, batch, request) * batch.overlap[k];
  spall.gaussian_curvature = cap_curvature(
      batch, k, request.is_side_a, context.parameters.breakage.curvature);
  spall.volume = cap_of(spall.overlap, spall.gaussian_curvature).volume;
  return spall;
}

/// The new body takes the place of the old one; returns the kinetic energy of
/// what left.
double replace_body(const ForceContext &context, ParticleSystem &particles,
                    std::size_t i, const ParticleShape &body)
{
  const double before = particles.kinetic_energy(i);
  particles.shape[i] = body;
  particles.update_mass(i, context.parameters.particle.density);
  if (particles.radius(i) < context.parameters.breakage.min_equivalent_radius)
    particles.is_breakable[i] = 0;
  return before - particles.kinetic_energy(i);
}
/// Evaluates all contacts of a particle again; returns the energy they gave up.
double reset_all(const ForceContext &context, ContactSet &contacts,
                 std::int32_t particle)
{
  ExactSum released;
  for (const ContactIndex &index : forget_surface(contacts, particle))
    released.add(reset(context, contacts, index));
  return released.value();
}

/// What is known of an event before the particle changes.
BreakageEvent announce(const ForceContext &context, ContactSet &contacts,
                       const Request &request)
{
  ContactBatch &batch = batch_of(contacts, request.batch);
  const ParticleSystem &particles = context.particles;
  const BreakageParameters &breakage = context.parameters.breakage;
  const std::size_t k = request.contact;
  const Spall spall = spall_at(context, batch, request);
  const double share = share_of(context, batch, request);
  BreakageEvent event;
  event.particle = particles.id[static_cast<std::size_t>(request.particle)];
  name_other(contacts, particles, request, event);
  event.mode = mode_now(batch, request, breakage);
  event.force_before = batch.normal_force[k];
  event.overlap = batch.overlap[k];
  event.elastic_energy = share * counted_energy(batch, k, breakage);
  event.fracture_energy = breakage.fracture_energy *
                          cap_of(spall.overlap, spall.gaussian_curvature).area;
  return event;
}

/// Lets the particle break at the contact; false if its shape refuses.
bool carry_out(const ForceContext &context, ParticleSystem &particles,
               ContactSet &contacts, const Request &request,
               BreakageEvent &event)
{
  const BreakageParameters &breakage = context.parameters.breakage;
  ContactBatch &batch = batch_of(contacts, request.batch);
  const auto i = static_cast<std::size_t>(request.particle);
  double &factor = factor_of(batch, request);
  factor = factor_after(event.mode, factor);
  const SpallResult result =
      apply_spall(particles.shape[i], spall_at(context, batch, request),
                  {breakage.kernel_floor, breakage.kernel_scale,
                   breakage.closure, breakage.inscribed},
                  sphere_rule(breakage.quadrature_rings));
  if (!result.is_accepted)
    return false;
  event.removed_volume = result.removed_volume;
  event.width = result.width;
  event.depth = result.depth;
  particles.path_length[i] += result.depth;
  event.kinetic_energy = replace_body(context, particles, i, result.body);
  event.equivalent_radius = particles.radius(i);
  event.released_energy = reset_all(context, contacts, request.particle);
  event.force_after = batch.normal_force[request.contact];
  return true;
}
} // namespace

BreakingSum break_particles(const ForceContext &context,
                            ParticleSystem &particles, ContactSet &contacts,
                            double time, std::vector<BreakageEvent> &events)
{
  const BreakageParameters &breakage = context.parameters.breakage;
  BreakingSum sum;
  for (const Request &request : collect(particles, contacts, breakage))
  {
    ContactBatch &batch = batch_of(contacts, request.batch);
    const auto is_off = [&]
    {
      return !particles
                  .is_breakable[static_cast<std::size_t>(request.particle)] ||
             mode_now(batch, request, breakage) == BreakageMode::none;
    };
    if (is_off())
      continue;
    // Before and after with surfaces as they are: else the event would be
    // given what the expansions of all its contacts are out of date by.
    sum.refreshed += reset_all(context, contacts, request.particle);
    if (is_off())
      continue;
    BreakageEvent event = announce(context, contacts, request);
    event.time = time;
    if (carry_out(context, particles, contacts, request, event))
      events.push_back(event);
    else
      ++sum.n_refused;
  }
  return sum;
}
} // namespace dem
