#include <dem/engine.h>
#include <dem/integrate/verlet.h>
#include <dem/search/candidates.h>

#include <chrono>
#include <utility>

namespace dem
{
namespace
{
/// Adds the wall-clock of its own life to a phase.
class Timer
{
public:
  explicit Timer(double &phase) : sum(phase), start(Clock::now()) {}
  ~Timer()
  {
    sum += std::chrono::duration<double>(Clock::now() - start).count();
  }
  Timer(const Timer &) = delete;
  Timer &operator=(const Timer &) = delete;

private:
  using Clock = std::chrono::steady_clock;
  double &sum;
  Clock::time_point start;
};

void sum_batch(const ContactBatch &batch, EngineEnergy &energy)
{
  for (std::size_t k = 0; k < batch.size(); ++k)
  {
    const Dissipation &lost = batch.lost[k];
    energy.friction += lost.friction;
    energy.rolling += lost.rolling;
    energy.damping += lost.damping;
    energy.shape_work += lost.shape_work;
    if (batch.is_touching(k))
      energy.elastic +=
          batch.history[k].normal_energy + tangential_energy(batch.history[k]);
  }
}
} // namespace

Engine::Engine(const EngineParameters &parameters)
    : settings(parameters),
      elasticity(
          mix({parameters.stone.shear_modulus, parameters.stone.poisson_ratio},
              {parameters.stone.shear_modulus, parameters.stone.poisson_ratio}))
{
}

void Engine::add_stone(const Body &body, const Vec3 &position,
                       const Quaternion &orientation)
{
  stones.add(body, position, orientation, settings.stone.density);
  const double diameter = 2. * stones.radius.back();
  stones.is_breakable.back() =
      body.series && diameter >= settings.breakage.min_diameter * (1. - 1e-9);
  damped.push_back(0.);
  lifted.push_back(0.);
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

void Engine::attach_surface(FacetSurface surface)
{
  facet_surface = std::move(surface);
  topology = std::make_unique<FacetTopology>(facet_surface);
  surface_load_before.assign(facet_surface.position.size(), Vec3::Zero());
  lists_are_stale = true;
}

void Engine::set_friction(double friction)
{
  settings.stone.friction = friction;
}

void Engine::set_local_damping(double damping)
{
  settings.local_damping = damping;
}

void Engine::come_to_rest()
{
  for (std::size_t i = 0; i < stones.size(); ++i)
  {
    damped[i] += 0.5 * stones.mass[i] * stones.velocity[i].squaredNorm() +
                 0.5 * stones.inertia[i] * stones.spin[i].squaredNorm();
    stones.velocity[i] = stones.spin[i] = Vec3::Zero();
  }
}

void Engine::set_breaking(bool is_on)
{
  settings.breakage.is_active = is_on;
}

void Engine::advance(double time_step)
{
  half_kick(time_step);
  move_planes(time_step);
  Speeds fastest;
  {
    const Timer timer(spent.motion);
    fastest = drift(stones, steepest, time_step);
  }
  now += time_step;
  ++step_count;
  keep_lists(fastest, time_step);
  if (evaluate_contacts(time_step))
    break_corners(time_step);
  sum_loads();
  load_planes(time_step);
  book_surface_work(time_step);
  half_kick(time_step);
}

void Engine::half_kick(double time_step)
{
  const Timer timer(spent.motion);
  kick(stones, {settings.gravity, settings.local_damping}, 0.5 * time_step,
       damped, lifted);
}

void Engine::move_planes(double time_step)
{
  for (Plane &plane : walls)
  {
    plane.point += time_step * plane.velocity;
    // Trapezoidal rule: this half with the old force, load_planes the other.
    plane.work -= 0.5 * time_step * plane.force.dot(plane.velocity);
  }
}

void Engine::keep_lists(const Speeds &fastest, double time_step)
{
  double boundary = 0.;
  for (const Plane &plane : walls)
    if (plane.is_active)
      boundary = std::max(boundary, plane.velocity.squaredNorm());
  for (const Vec3 &velocity : facet_surface.velocity)
    boundary = std::max(boundary, velocity.squaredNorm());
  boundary = std::sqrt(boundary);
  travelled +=
      (fastest.closing + std::max(fastest.closing, boundary)) * time_step;
  margin_left -=
      (fastest.moving + std::max(fastest.moving, boundary)) * time_step;
  if (lists_are_stale || margin_left < 0.)
    rebuild_lists();
}

void Engine::rebuild_lists()
{
  const Timer timer(spent.search);
  const double margin = settings.search_margin;
  rebuild_pairs(stones, margin, pair_batch, retired);
  const WallSearch search{settings.geometry.wall_geometry, margin};
  rebuild_planes(stones, walls, search, plane_batch, retired);
  if (has_surface())
    rebuild_facets(stones, facet_surface, search, facet_candidates, facet_batch,
                   retired);
  pair_row.assign(stones.size() + 1, 0);
  for (std::size_t k = 0; k < pair_batch.size(); ++k)
  {
    ++pair_row[static_cast<std::size_t>(pair_batch.a[k]) + 1];
    ++pair_row[static_cast<std::size_t>(pair_batch.b[k]) + 1];
  }
  for (std::size_t i = 0; i < stones.size(); ++i)
    pair_row[i + 1] += pair_row[i];
  pair_entry.resize(2 * pair_batch.size());
  std::vector<std::int32_t> next(pair_row.begin(), pair_row.end() - 1);
  const auto enter = [&](std::int32_t stone, std::int32_t entry)
  {
    auto &place = next[static_cast<std::size_t>(stone)];
    pair_entry[static_cast<std::size_t>(place++)] = entry;
  };
  for (std::size_t k = 0; k < pair_batch.size(); ++k)
  {
    const auto number = static_cast<std::int32_t>(k);
    enter(pair_batch.a[k], number);
    enter(pair_batch.b[k], -1 - number);
  }
  steepest = branch_steepness();
  margin_left = margin;
  lists_are_stale = false;
  ++rebuild_count;
}

double Engine::branch_steepness() const
{
  return settings.geometry.geometry == ContactGeometry::radial
             ? steepness(stones)
             : 0.;
}

bool Engine::evaluate_contacts(double time_step)
{
  const Timer timer(spent.contacts);
  const ForceContext context{settings, elasticity, stones, time_step,
                             travelled};
  bool wants_breakage = pair_forces(context, pair_batch);
  wants_breakage |= plane_forces(context, walls, plane_batch);
  if (has_surface())
    wants_breakage |= facet_forces(context, facet_surface, *topology,
                                   facet_candidates, facet_batch);
  return wants_breakage;
}

void Engine::break_corners(double time_step)
{
  const Timer timer(spent.breakage);
  const ForceContext context{settings, elasticity, stones, time_step,
                             travelled};
  ContactSet contacts{pair_batch, plane_batch,   facet_batch,
                      walls,      facet_surface, facet_candidates};
  const std::size_t before = events.size();
  refused_count += break_stones(context, stones, contacts, now, events);
  for (std::size_t e = before; e < events.size(); ++e)
  {
    released += events[e].released_energy + events[e].kinetic_energy;
    fractured += events[e].fracture_energy;
  }
  steepest = branch_steepness();
  event_count += static_cast<std::int64_t>(events.size() - before);
}

void Engine::sum_loads()
{
  const Timer timer(spent.contacts);
  const auto n = static_cast<std::int64_t>(stones.size());
#pragma omp parallel for schedule(static)
  for (std::int64_t entry = 0; entry < n; ++entry)
  {
    const auto i = static_cast<std::size_t>(entry);
    Vec3 force = Vec3::Zero(), moment = Vec3::Zero();
    for (std::int32_t e = pair_row[i]; e < pair_row[i + 1]; ++e)
    {
      const std::int32_t number = pair_entry[static_cast<std::size_t>(e)];
      const bool is_a = number >= 0;
      const ContactLoad &load =
          pair_batch
              .load[static_cast<std::size_t>(is_a ? number : -1 - number)];
      force += is_a ? load.force : Vec3(-load.force);
      moment += is_a ? load.moment_a : load.moment_b;
    }
    stones.force[i] = force;
    stones.moment[i] = moment;
  }
  for (const ContactBatch *batch : {&plane_batch, &facet_batch})
    for (std::size_t k = 0; k < batch->size(); ++k)
    {
      const auto i = static_cast<std::size_t>(batch->a[k]);
      stones.force[i] += batch->load[k].force;
      stones.moment[i] += batch->load[k].moment_a;
    }
}

void Engine::load_planes(double time_step)
{
  for (Plane &plane : walls)
    plane.force = Vec3::Zero();
  for (std::size_t k = 0; k < plane_batch.size(); ++k)
    walls[static_cast<std::size_t>(plane_batch.b[k])].force -=
        plane_batch.load[k].force;
  for (Plane &plane : walls)
    plane.work -= 0.5 * time_step * plane.force.dot(plane.velocity);
}

void Engine::book_surface_work(double time_step)
{
  if (!has_surface())
    return;
  load_surface(facet_candidates, facet_batch, facet_surface);
  double power = 0.;
  for (std::size_t v = 0; v < facet_surface.load.size(); ++v)
    power += 0.5 * (surface_load_before[v] + facet_surface.load[v])
                       .dot(facet_surface.velocity[v]);
  pushed -= power * time_step;
  surface_load_before = facet_surface.load;
}

EngineEnergy Engine::energy() const
{
  EngineEnergy energy;
  energy.friction = retired.friction;
  energy.rolling = retired.rolling;
  energy.damping = retired.damping;
  energy.shape_work = retired.shape_work;
  for (const ContactBatch *batch : {&pair_batch, &plane_batch, &facet_batch})
    sum_batch(*batch, energy);
  for (std::size_t i = 0; i < stones.size(); ++i)
  {
    energy.kinetic += 0.5 * stones.mass[i] * stones.velocity[i].squaredNorm() +
                      0.5 * stones.inertia[i] * stones.spin[i].squaredNorm();
    energy.damping += damped[i];
    energy.gravity_work += lifted[i];
  }
  energy.breakage = released;
  energy.fracture = fractured;
  for (const Plane &plane : walls)
    energy.plane_work += plane.work;
  energy.surface_work = pushed;
  return energy;
}

std::vector<BreakageEvent> Engine::take_events()
{
  return std::exchange(events, {});
}
} // namespace dem
