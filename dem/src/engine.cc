#include "engine_state.h"
#include "phase_timer.h"

#include <dem/integrate/verlet.h>

#include <algorithm>
#include <stdexcept>
#include <string>
#include <utility>

namespace dem
{
namespace
{
double elastic_energy(const ContactBatch &batch)
{
  double energy = 0.;
  for (std::size_t k = 0; k < batch.size(); ++k)
    if (batch.has_force(k))
      energy += batch.stored_energy(k);
  return energy;
}
} // namespace

EngineState::EngineState(const EngineParameters &parameters)
    : settings(parameters), elasticity(parameters)
{
  schedule.skin.given = settings.geometry.skin;
}

void EngineState::add_particle(const ParticleShape &body, const Vec3 &position,
                               const Quaternion &orientation,
                               std::uint8_t material)
{
  if (!position.allFinite() || !orientation.coeffs().allFinite())
    throw std::invalid_argument(
        "particle " + std::to_string(system.size()) +
        ": position and orientation must be finite numbers");
  synchronize(); // none for the new one
  system.follows_surfaces = settings.geometry.follows_surfaces();
  ParticleShape particle = body;
  if (settings.breakage.inscribed == InscribedSphereAt::free)
    free_corner_radius(particle,
                       sphere_rule(settings.breakage.quadrature_rings));
  system.add(particle, position, orientation,
             material == 0 ? settings.particle.density
                           : settings.other_solids.at(material - 1u).density);
  system.material.back() = material;
  system.has_materials |= material != 0;
  pair_finder.forget();
  contact_points.forget();
  const double diameter = 2. * system.last().radius;
  system.is_breakable.back() =
      body.series && material == 0 &&
      diameter >= settings.breakage.min_diameter * (1. - 1e-9);
  work.damped.push_back(0.);
  work.lifted.push_back(0.);
  schedule.invalidate();
}

Boundary &EngineState::add_boundary(std::unique_ptr<Boundary> boundary)
{
  // Sums over boundaries are in one order, in whatever order a scene is built.
  const auto after = std::ranges::upper_bound(
      walls, boundary->rank(), {},
      [](const std::unique_ptr<Boundary> &one) { return one->rank(); });
  schedule.invalidate();
  return **walls.insert(after, std::move(boundary));
}

void EngineState::set_periodic_cell(const Vec3 &centre, const Vec3 &length)
{
  if (length.minCoeff() < 0. || !length.allFinite())
    throw std::invalid_argument("periodic cell: lengths must not be negative");
  if (settings.geometry.follows_surfaces())
    throw std::invalid_argument("periodic cell: contacts of true surfaces do "
                                "not reach across its faces");
  system.cell.centre = centre;
  system.cell.length = length;
  schedule.invalidate();
}

void EngineState::set_friction(double friction)
{
  settings.particle.friction = friction;
}

void EngineState::set_local_damping(double damping)
{
  synchronize(); // with the damping of its step
  settings.local_damping = damping;
}

void EngineState::set_renewal(double refresh_tolerance, double skin)
{
  settings.geometry.refresh_tolerance = refresh_tolerance;
  settings.geometry.skin = schedule.skin.given = skin;
}

void EngineState::come_to_rest()
{
  synchronize();
  for (std::size_t i = 0; i < system.size(); ++i)
  {
    work.damped[i] += system.kinetic_energy(i);
    system.velocity(i) = system.spin(i) = Vec3::Zero();
  }
}

void EngineState::set_breaking(bool is_on)
{
  if (is_on != settings.breakage.is_active)
    schedule.invalidate();
  // Caps of relative curvature are made where prefactors are mixed.
  if (settings.breakage.curvature == CapCurvature::relative)
    std::fill(pair_batch.torsion_angle.begin(), pair_batch.torsion_angle.end(),
              10.f);
  settings.breakage.is_active = is_on;
}

void EngineState::set_repetitions(double repetitions)
{
  if ((repetitions > 1.) != (settings.breakage.repetitions > 1.))
    schedule.invalidate();
  settings.breakage.repetitions = repetitions;
  visit_batches(*this, [](ContactBatch &batch)
                { std::fill(batch.peak.begin(), batch.peak.end(), 0.); });
}

void EngineState::advance(double time_step)
{
  advance_deferred(time_step);
  synchronize();
}

void EngineState::advance_deferred(double time_step)
{
  move_boundaries(time_step);
  move_cell(time_step);
  const Speeds fastest = move_particles(time_step);
  now += time_step;
  ++step_count;
  keep_lists(fastest, time_step);
  const bool wants_breakage = evaluate_contacts(time_step);
  load_boundaries(time_step);
  pending_half_kick = 0.5 * time_step;
  if (wants_breakage)
    break_corners();
}

void EngineState::evaluate(double time_step)
{
  if (schedule.n_made > 0)
    throw std::logic_error("engine: contacts are evaluated as placed before "
                           "the first step only");
  rebuild_lists();
  std::fill(system.load.begin(), system.load.end(), ParticleLoad{});
  evaluate_contacts(time_step);
  load_boundaries(0.);
}

Speeds EngineState::move_particles(double time_step)
{
  const PhaseTimer timer(spent.motion);
  return kick_and_drift(system,
                        {{settings.gravity, settings.local_damping},
                         steepest,
                         std::exchange(pending_half_kick, 0.),
                         time_step},
                        work);
}

void EngineState::synchronize()
{
  if (pending_half_kick == 0.)
    return;
  const PhaseTimer timer(spent.motion);
  kick(system, {settings.gravity, settings.local_damping},
       std::exchange(pending_half_kick, 0.), work);
}

void EngineState::require_synchronized() const
{
  if (pending_half_kick != 0.)
    throw std::logic_error("engine: a half kick is pending, synchronize() must "
                           "come between advance_deferred() and this");
}

ForceContext EngineState::context(double time_step)
{
  ForceContext context{settings, elasticity, system, time_step};
  context.path_length = schedule.path_length;
  context.step_path = schedule.step_path;
  context.gap_path = schedule.paths.gaps;
  context.cell_path = schedule.paths.cell;
  context.deforming_path = schedule.deforming_path;
  context.known_overlap = overlap.recent * least_radius;
  return context;
}

bool EngineState::evaluate_contacts(double time_step)
{
  const PhaseTimer timer(spent.contacts);
  meet_walls(time_step);
  return run_contacts(context(time_step));
}

/// Forces of all contacts and the loads on all particles, zero before; true if
/// some side requests breakage.
bool EngineState::run_contacts(const ForceContext &all)
{
  ForceSum sum = pair_forces(all, pair_batch, pair_loads, ranges);
  for (const auto &boundary : walls)
    sum += wall_forces(all, boundary->walls(all), boundary->batch, ranges);
  if (sum.has_switched)
    exchange_factors();
  system.cell.force = sum.cell_force;
  lost += sum.lost;
  count_contact_point_events(sum);
  note_overlap(sum.overlap_ratio);
  return sum.wants_breakage;
}

void EngineState::count_contact_point_events(const ForceSum &sum)
{
  contact_points.events.n_jumps += sum.n_jumps;
  contact_points.events.n_ended += sum.n_ended;
  // Two contacts may be one now, and what is gone may be found elsewhere.
  if (sum.has_displaced)
    schedule.note_displaced();
}

void EngineState::exchange_factors()
{
  visit_batches(*this,
                [this](ContactBatch &batch)
                {
                  if (batch.layout.has_damage)
                    patches.exchange(system, batch);
                });
}

/// Work is booked by the trapezoidal rule: this half of the step with the
/// forces of before, the next with those of after the events.
void EngineState::break_corners()
{
  synchronize();
  const PhaseTimer timer(spent.breakage);
  ContactSet contacts{pair_batch, walls};
  const std::size_t before = events.size();
  const BreakingSum done =
      break_particles(context(0.), system, contacts, now, events);
  if (settings.breakage.memory == FactorMemory::patch)
    exchange_factors(); // of contacts that the events opened
  refused_count += done.n_refused;
  lost.non_conservative_work += done.refreshed;
  for (std::size_t e = before; e < events.size(); ++e)
  {
    released += events[e].released_energy + events[e].kinetic_energy;
    fractured += events[e].fracture_energy;
    // No kernel is larger than one: nowhere has the particle grown by more.
    schedule.grow(events[e].depth);
  }
  steepest = branch_steepness();
  least_radius = system.smallest_radius();
  event_count += static_cast<std::int64_t>(events.size() - before);
  ForceContext still = context(0.);
  still.adds_loads_only = true;
  std::fill(system.load.begin(), system.load.end(), ParticleLoad{});
  run_contacts(still);
  load_boundaries(0.);
  // A chip may have moved contacts of the particle.
  visit_batches(*this,
                [this](const ContactBatch &batch)
                {
                  if (have_displaced(batch))
                    schedule.note_displaced();
                });
}

EngineEnergy EngineState::energy() const
{
  require_synchronized();
  EngineEnergy energy;
  energy.friction = lost.friction;
  energy.rolling = lost.rolling;
  energy.damping = lost.damping;
  energy.non_conservative_work = lost.non_conservative_work;
  visit_batches(*this, [&energy](const ContactBatch &batch)
                { energy.elastic += elastic_energy(batch); });
  for (std::size_t i = 0; i < system.size(); ++i)
  {
    energy.kinetic += system.kinetic_energy(i);
    energy.damping += work.damped[i];
    energy.gravity_work += work.lifted[i];
  }
  energy.breakage = released;
  energy.fracture = fractured;
  for (const auto &boundary : walls)
    energy.boundary_work[boundary->kind()] += boundary->work();
  energy.cell_work = system.cell.work;
  return energy;
}

std::vector<BreakageEvent> EngineState::take_events()
{
  return std::exchange(events, {});
}
} // namespace dem
