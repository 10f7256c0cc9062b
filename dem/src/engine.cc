#include "engine_state.h"
#include "phase_timer.h"

#include <dem/integrate/verlet.h>
#include <dem/parallel/breaking.h>
#include <dem/parallel/rank_sums.h>
#include <dem/particles/density_scaling.h>

#include <algorithm>
#include <array>
#include <stdexcept>
#include <string>
#include <utility>

namespace dem
{
namespace
{
void add_elastic_energy(const ContactBatch &batch, ExactSum &energy)
{
  for (std::size_t k = 0; k < batch.size(); ++k)
    if (batch.has_force(k))
      energy.add(batch.stored_energy(k));
}
} // namespace

EngineState::EngineState(const EngineParameters &parameters,
                         std::shared_ptr<Ranks> ranks)
    : distribution(std::move(ranks)), settings(parameters),
      elasticity(parameters)
{
  schedule.skin.given = settings.geometry.skin;
  if (settings.density_scaling_diameter > 0. && !settings.gravity.isZero(0.))
    throw std::invalid_argument(
        "density scaling changes weights: gravity must be zero with it");
}

void EngineState::add_particle(const ParticleShape &body, const Vec3 &position,
                               const Quaternion &orientation,
                               std::uint8_t material)
{
  if (!position.allFinite() || !orientation.coeffs().allFinite())
    throw std::invalid_argument(
        "particle " + std::to_string(added_count) +
        ": position and orientation must be finite numbers");
  synchronize(); // none for the new one
  system.follows_surfaces = settings.geometry.follows_surfaces();
  system.has_materials |= material != 0;
  system.has_shapes |= body.series != nullptr;
  schedule.invalidate();
  const std::int64_t id = added_count++;
  largest_radius = std::max(largest_radius, mean_radius(body));
  pair_finder.forget();
  contact_points.forget();
  // Until they go to their owners particles are dealt out.
  if (id % distribution.ranks().size() != distribution.ranks().rank())
    return;
  const NewParticle particle{body, position, orientation, material, id};
  if (distribution.is_shared() && schedule.n_made > 0)
    arrivals.push_back(particle);
  else
    append(particle);
}

void EngineState::append(const NewParticle &particle)
{
  ParticleShape body = particle.body;
  const std::uint8_t material = particle.material;
  if (settings.breakage.inscribed == InscribedSphereAt::free)
    free_corner_radius(body, sphere_rule(settings.breakage.quadrature_rings));
  const bool is_particle = material == 0;
  system.add(body, particle.position, particle.orientation,
             is_particle ? settings.particle.density
                         : settings.other_solids.at(material - 1u).density,
             is_particle ? density_scaling(2. * mean_radius(body),
                                           settings.density_scaling_diameter)
                         : 1.);
  system.id.back() = particle.id;
  system.material.back() = material;
  const double diameter = 2. * system.last().radius;
  system.is_breakable.back() =
      body.series && material == 0 &&
      diameter >= settings.breakage.min_diameter * (1. - 1e-9);
  work.damped.push_back(0.);
  work.lifted.push_back(0.);
}

Boundary &EngineState::add_boundary(std::unique_ptr<Boundary> boundary)
{
  // Sums over boundaries are in one order, in whatever order a scene is built.
  const auto after =
      std::ranges::upper_bound(walls, boundary->evaluation_order(), {},
                               [](const std::unique_ptr<Boundary> &one)
                               { return one->evaluation_order(); });
  schedule.invalidate();
  return **walls.insert(after, std::move(boundary));
}

void EngineState::set_periodic_cell(const Vec3 &centre, const Vec3 &length)
{
  if (length.minCoeff() < 0. || !length.allFinite())
    throw std::invalid_argument("periodic cell: lengths must not be negative");
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
  for (std::size_t i = 0; i < system.n_owned(); ++i)
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
  admit_arrivals();
  move_boundaries(time_step);
  move_cell(time_step);
  const Speeds fastest = over_ranks(move_particles(time_step));
  now += time_step;
  ++step_count;
  send_states();
  keep_lists(fastest, time_step);
  keep_grid();
  wants_breakage = evaluate_contacts(time_step);
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
  if (distribution.is_shared())
    throw std::logic_error("engine: contacts are evaluated on one rank");
  rebuild_lists();
  std::fill(system.load.begin(), system.load.end(), ParticleLoad{});
  // Of few contacts, and to the last digit.
  const SumGrid of_steps = std::exchange(grid, {});
  evaluate_contacts(time_step);
  load_boundaries(0.);
  grid = of_steps;
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
  context.grid = grid;
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
  {
    const ForceSum on_wall =
        wall_forces(all, boundary->walls(all), boundary->batch, ranges);
    boundary->friction += on_wall.lost.friction;
    sum += on_wall;
  }
  if (sum.has_switched)
    exchange_factors();
  if (distribution.is_shared())
  {
    const PhaseTimer timer(spent.exchange);
    distribution.collect_loads(system);
  }
  system.cell.force = sum.cell_force;
  lost += sum.lost;
  largest_force = sum.largest_force;
  recent_force = std::max(recent_force, largest_force);

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

/// The loads of all contacts with their forces as they are.
void EngineState::add_loads_again()
{
  ForceContext still = context(0.);
  still.adds_loads_only = true;
  std::fill(system.load.begin(), system.load.end(), ParticleLoad{});
  run_contacts(still);
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
  const std::size_t before = events.size();
  const BreakingSum done = carry_out_breakage();
  if (settings.breakage.memory == FactorMemory::patch)
    exchange_factors(); // of contacts that the events opened
  refused_count += done.n_refused;
  if (distribution.ranks().rank() == 0) // the same on all ranks
    lost.non_conservative_work.add(done.refreshed);
  for (std::size_t e = before; e < events.size(); ++e)
  {
    released += events[e].released_energy + events[e].kinetic_energy;
    fractured += events[e].fracture_energy;
    // No kernel is larger than one: nowhere has the particle grown by more.
    schedule.grow(events[e].depth);
  }
  note_extremes();
  event_count += static_cast<std::int64_t>(events.size() - before);
  add_loads_again();
  load_boundaries(0.);
  // A chip may have moved contacts of the particle.
  visit_batches(*this,
                [this](const ContactBatch &batch)
                {
                  if (have_displaced(batch))
                    schedule.note_displaced();
                });
}

BreakingSum EngineState::carry_out_breakage()
{
  if (distribution.is_shared())
    return break_shared(context(0.), parts(), distribution, now, events);
  ContactSet contacts{pair_batch, walls};
  return break_particles(context(0.), system, contacts, now, events);
}

EngineEnergy EngineState::energy() const
{
  require_synchronized();
  ExactSum elastic, kinetic, damping = lost.damping, lifted;
  visit_batches(*this, [&elastic](const ContactBatch &batch)
                { add_elastic_energy(batch, elastic); });
  ExactSum unbooked = lost.non_conservative_work;
  for (const auto &boundary : walls)
    for (std::size_t k = 0; k < boundary->batch.size(); ++k)
      if (const double more = boundary->energy_beyond_springs(k); more != 0.)
      {
        elastic.add(more);
        unbooked.add(-more);
      }
  for (std::size_t i = 0; i < system.n_owned(); ++i)
  {
    kinetic.add(system.kinetic_energy(i));
    damping.add(work.damped[i]);
    lifted.add(work.lifted[i]);
  }
  std::array sums{elastic,       kinetic,      damping, lifted,
                  lost.friction, lost.rolling, unbooked};
  sum_over_ranks(distribution.ranks(), sums);
  EngineEnergy energy;
  energy.elastic = sums[0].value();
  energy.kinetic = sums[1].value();
  energy.damping = sums[2].value();
  energy.gravity_work = sums[3].value();
  energy.friction = sums[4].value();
  energy.rolling = sums[5].value();
  energy.non_conservative_work = sums[6].value();
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
