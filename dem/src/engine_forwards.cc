// What Engine does is done by EngineState.
#include "engine_state.h"

#include <sstream>
#include <utility>

namespace dem
{
Engine::Engine(const EngineParameters &parameters, std::shared_ptr<Ranks> ranks)
    : state(std::make_unique<EngineState>(parameters, std::move(ranks)))
{
}

Engine::Engine(std::unique_ptr<EngineState> its_state)
    : state(std::move(its_state))
{
}

Engine::Engine(Engine &&) noexcept = default;
Engine &Engine::operator=(Engine &&) noexcept = default;
Engine::~Engine() = default;

void Engine::add_particle(const ParticleShape &body, const Vec3 &position,
                          const Quaternion &orientation, std::uint8_t material)
{
  state->add_particle(body, position, orientation, material);
}

Boundary &Engine::add_boundary(std::unique_ptr<Boundary> boundary)
{
  return state->add_boundary(std::move(boundary));
}

std::span<const std::unique_ptr<Boundary>> Engine::boundaries() const
{
  return std::as_const(*state).boundaries();
}

void Engine::lists_changed()
{
  state->lists_changed();
}

void Engine::set_periodic_cell(const Vec3 &centre, const Vec3 &length)
{
  state->set_periodic_cell(centre, length);
}

const PeriodicCell &Engine::cell() const
{
  return std::as_const(*state).cell();
}

void Engine::set_cell_rate(const Vec3 &rate)
{
  state->set_cell_rate(rate);
}

void Engine::advance(double time_step)
{
  state->advance(time_step);
}

void Engine::advance_deferred(double time_step)
{
  state->advance_deferred(time_step);
}

void Engine::synchronize()
{
  state->synchronize();
  state->admit_arrivals();
}

void Engine::evaluate(double time_step)
{
  state->evaluate(time_step);
}

const EngineParameters &Engine::parameters() const
{
  return std::as_const(*state).parameters();
}

void Engine::set_friction(double friction)
{
  state->set_friction(friction);
}

void Engine::set_local_damping(double damping)
{
  state->set_local_damping(damping);
}

void Engine::set_renewal(double refresh_tolerance, double skin)
{
  state->set_renewal(refresh_tolerance, skin);
}

void Engine::allow_escape()
{
  state->allow_escape();
}

void Engine::come_to_rest()
{
  state->come_to_rest();
}

void Engine::set_breaking(bool is_on)
{
  state->set_breaking(is_on);
}

void Engine::set_repetitions(double repetitions)
{
  state->set_repetitions(repetitions);
}

const ParticleSystem &Engine::particles() const
{
  return std::as_const(*state).particles();
}

ParticleSystem &Engine::particles()
{
  return state->particles();
}

const ContactBatch &Engine::pairs() const
{
  return std::as_const(*state).pairs();
}

const Distribution &Engine::distribution() const
{
  return state->shares();
}

void Engine::set_partition_interval(std::int64_t interval)
{
  state->set_partition_interval(interval);
}

double Engine::time() const
{
  return std::as_const(*state).time();
}

void Engine::set_time(double time)
{
  state->set_time(time);
}

std::int64_t Engine::n_steps() const
{
  return std::as_const(*state).n_steps();
}

std::int64_t Engine::n_rebuilds() const
{
  return std::as_const(*state).n_rebuilds();
}

double Engine::listed_gap() const
{
  return std::as_const(*state).listed_gap();
}

const ContactPointEvents &Engine::contact_point_events() const
{
  return std::as_const(*state).contact_point_events();
}

EngineEnergy Engine::energy() const
{
  return std::as_const(*state).energy();
}

EngineClock Engine::clock() const
{
  return std::as_const(*state).clock();
}

const OverlapRecord &Engine::overlaps() const
{
  return std::as_const(*state).overlaps();
}

void Engine::begin_overlap_interval()
{
  state->begin_overlap_interval();
}

std::vector<BreakageEvent> Engine::take_events()
{
  return state->take_events();
}

std::int64_t Engine::n_events() const
{
  return std::as_const(*state).n_events();
}

int Engine::n_refused_events() const
{
  return std::as_const(*state).n_refused_events();
}

Engine Engine::gathered() const
{
  return Engine(state->gathered());
}

void Engine::order_by_id()
{
  state->synchronize();
  state->order_by_id();
}

bool Engine::is_shareable() const
{
  return state->is_shareable();
}

void Engine::save(
    std::ostream &out,
    const std::vector<std::shared_ptr<const Coefficients>> &library,
    StateExtent extent) const
{
  state->save(out, library, extent);
}

void Engine::restore(
    std::istream &in,
    const std::vector<std::shared_ptr<const Coefficients>> &library)
{
  state->restore(in, library);
}
} // namespace dem
