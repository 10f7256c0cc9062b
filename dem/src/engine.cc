#include "phase_timer.h"

#include <dem/engine.h>
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
    if (batch.is_touching(k))
      energy += batch.stored_energy(k);
  return energy;
}

} // namespace

Engine::Engine(const EngineParameters &parameters)
    : settings(parameters), elasticity(parameters)
{
  margin.given = settings.geometry.skin;
}

void Engine::add_particle(const ParticleShape &body, const Vec3 &position,
                          const Quaternion &orientation, std::uint8_t material)
{
  if (!position.allFinite() || !orientation.coeffs().allFinite())
    throw std::invalid_argument(
        "particle " + std::to_string(system.size()) +
        ": position and orientation must be finite numbers");
  finish_kick(); // none for the new one
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
  lists_are_stale = true;
}

std::size_t Engine::add_plane(const Vec3 &point, const Vec3 &normal)
{
  walls.push_back({point, normal.normalized()});
  lists_are_stale = true;
  return walls.size() - 1;
}

void Engine::deactivate_plane(std::size_t plane)
{
  walls[plane].is_active = false;
  walls[plane].force = Vec3::Zero();
  lists_are_stale = true;
}

void Engine::place_plane(std::size_t plane, const Vec3 &point)
{
  walls[plane].point = point;
  walls[plane].velocity = Vec3::Zero();
  walls[plane].is_active = true;
  lists_are_stale = true;
}

void Engine::set_drum(const Drum &drum)
{
  barrel = drum;
  lifter = DrumLifter(drum);
  lists_are_stale = true;
}

std::size_t Engine::add_surface(const std::string &name,
                                const WallMaterial &material,
                                FacetSurface surface)
{
  for (const SurfaceContacts &other : facet_surfaces)
    if (other.name == name)
      throw std::invalid_argument("facet surface: there are two of the name " +
                                  name);
  facet_surfaces.emplace_back(name, material, std::move(surface));
  lists_are_stale = true;
  return facet_surfaces.size() - 1;
}

void Engine::attach_surface(FacetSurface surface)
{
  add_surface("surface", settings.surface, std::move(surface));
}

void Engine::set_friction(double friction)
{
  settings.particle.friction = friction;
}

void Engine::set_local_damping(double damping)
{
  finish_kick(); // with the damping of its step
  settings.local_damping = damping;
}

void Engine::set_renewal(double refresh_tolerance, double skin)
{
  settings.geometry.refresh_tolerance = refresh_tolerance;
  settings.geometry.skin = margin.given = skin;
}

void Engine::come_to_rest()
{
  finish_kick();
  for (std::size_t i = 0; i < system.size(); ++i)
  {
    work.damped[i] += system.kinetic_energy(i);
    system.velocity(i) = system.spin(i) = Vec3::Zero();
  }
}

void Engine::set_breaking(bool is_on)
{
  lists_are_stale |= is_on != settings.breakage.is_active;
  // Caps of relative curvature are made where prefactors are mixed.
  if (settings.breakage.curvature == CapCurvature::relative)
    std::fill(pair_batch.torsion_angle.begin(), pair_batch.torsion_angle.end(),
              10.f);
  settings.breakage.is_active = is_on;
}

void Engine::set_repetitions(double repetitions)
{
  lists_are_stale |= (repetitions > 1.) != (settings.breakage.repetitions > 1.);
  settings.breakage.repetitions = repetitions;
  visit_batches(*this, [](ContactBatch &batch)
                { std::fill(batch.peak.begin(), batch.peak.end(), 0.); });
}

void Engine::advance(double time_step)
{
  advance_deferred(time_step);
  finish_kick();
}

void Engine::advance_deferred(double time_step)
{
  move_planes(time_step);
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

void Engine::evaluate(double time_step)
{
  if (rebuild_count > 0)
    throw std::logic_error("engine: contacts are evaluated as placed before "
                           "the first step only");
  rebuild_lists();
  std::fill(system.load.begin(), system.load.end(), ParticleLoad{});
  evaluate_contacts(time_step);
  load_boundaries(0.);
}

Speeds Engine::move_particles(double time_step)
{
  const PhaseTimer timer(spent.motion);
  return kick_and_drift(system,
                        {{settings.gravity, settings.local_damping},
                         steepest,
                         std::exchange(pending_half_kick, 0.),
                         time_step},
                        work);
}

void Engine::finish_kick() const
{
  if (pending_half_kick == 0.)
    return;
  const PhaseTimer timer(spent.motion);
  kick(system, {settings.gravity, settings.local_damping},
       std::exchange(pending_half_kick, 0.), work);
}

ForceContext Engine::context(double time_step)
{
  return {settings,    elasticity, system,
          time_step,   travelled,  stride,
          travel.gaps, false,      overlap.recent * least_radius};
}

bool Engine::evaluate_contacts(double time_step)
{
  const PhaseTimer timer(spent.contacts);
  meet_walls(time_step);
  return run_contacts(context(time_step));
}

/// Forces of all contacts and the loads on all particles, zero before; true if
/// some side asks for breakage.
bool Engine::run_contacts(const ForceContext &all)
{
  ForceSum sum = pair_forces(all, pair_batch, pair_loads, ranges);
  sum += wall_forces(all, walls_of_planes(), plane_batch, ranges);
  if (barrel.is_there())
    sum += wall_forces(all, walls_of_drum(), drum_batch, ranges);
  for (SurfaceContacts &facets : facet_surfaces)
    sum += wall_forces(all, walls_of_facets(facets), facets.batch, ranges);
  if (sum.has_switched)
    exchange_factors();
  lost += sum.lost;
  count_places(sum);
  note_overlap(sum.overlap_ratio);
  return sum.wants_breakage;
}

void Engine::count_places(const ForceSum &sum)
{
  contact_points.events.n_jumps += sum.n_jumps;
  contact_points.events.n_ended += sum.n_ended;
  // Two contacts may be one now, and what is gone may be found elsewhere.
  places_are_stale |= sum.has_displaced;
}

void Engine::exchange_factors()
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
void Engine::break_corners()
{
  finish_kick();
  const PhaseTimer timer(spent.breakage);
  std::vector<Walls> of_surfaces;
  for (SurfaceContacts &facets : facet_surfaces)
    of_surfaces.push_back(walls_of_facets(facets));
  ContactSet contacts{pair_batch,        plane_batch,     drum_batch,
                      walls_of_planes(), walls_of_drum(), facet_surfaces,
                      of_surfaces};
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
    margin.left -= events[e].depth;
    facets_left -= events[e].depth;
    travel.centres += events[e].depth;
    travel.gaps += events[e].depth;
  }
  steepest = branch_steepness();
  least_radius = system.smallest_radius();
  event_count += static_cast<std::int64_t>(events.size() - before);
  ForceContext still = context(0.);
  still.adds_loads_only = true;
  std::fill(system.load.begin(), system.load.end(), ParticleLoad{});
  run_contacts(still);
  load_boundaries(0.);
  // A chip may have led contacts of the particle elsewhere.
  visit_batches(*this, [this](const ContactBatch &batch)
                { places_are_stale |= have_displaced(batch); });
}

EngineEnergy Engine::energy() const
{
  finish_kick();
  EngineEnergy energy;
  energy.friction = lost.friction;
  energy.rolling = lost.rolling;
  energy.damping = lost.damping;
  energy.non_conservative_work = lost.non_conservative_work;
  visit_batches(*this, [&energy](const ContactBatch &batch)
                { energy.elastic += elastic_energy(batch); });
  for (const SurfaceContacts &facets : facet_surfaces)
    energy.surface_work += facets.work;
  for (std::size_t i = 0; i < system.size(); ++i)
  {
    energy.kinetic += system.kinetic_energy(i);
    energy.damping += work.damped[i];
    energy.gravity_work += work.lifted[i];
  }
  energy.breakage = released;
  energy.fracture = fractured;
  for (const Plane &plane : walls)
    energy.plane_work += plane.work;
  energy.drum_work = barrel.work;
  return energy;
}

std::vector<BreakageEvent> Engine::take_events()
{
  return std::exchange(events, {});
}
} // namespace dem
