#pragma once

#include <dem/boundary/boundary.h>
#include <dem/breakage/events.h>
#include <dem/engine_energy.h>
#include <dem/integrate/time_step.h>
#include <dem/parallel/ranks.h>

#include <cstdint>
#include <iosfwd>
#include <memory>
#include <span>
#include <vector>

namespace dem
{
class Distribution;
class EngineState;

/// Whose state Engine::save() writes.
enum class StateExtent : std::int32_t
{
  /// What this rank has, as it stands: to come back to it on the same ranks.
  rank,
  /// Of all ranks, in the order of the ids: the same bytes on any number of
  /// ranks, and any number continues. The first rank alone writes; all of them
  /// must read the same bytes (dem/parallel/shared_input.h).
  scene
};

/// The particles, their contacts and boundaries, and how they move: the one
/// class of dem with state.
class Engine
{
public:
  /// On many ranks each owns the particles in its box, and every function that
  /// changes the scene or asks for a sum is called by all of them, in the same
  /// order: see docs/developer/parallel.md.
  explicit Engine(const EngineParameters &parameters,
                  std::shared_ptr<Ranks> ranks = one_rank());
  Engine(Engine &&) noexcept;
  Engine &operator=(Engine &&) noexcept;
  ~Engine();

  /// A particle at rest, at any time; of another material than 0 it does not
  /// break. Its id is the number of particles before it. On many ranks every
  /// rank adds all particles, and one keeps it; one that is added after the
  /// first step is there from the next step on.
  void add_particle(const ParticleShape &body, const Vec3 &position,
                    const Quaternion &orientation, std::uint8_t material = 0);
  /// Adds a boundary after all of its Boundary::evaluation_order() or a lower
  /// one: planes, the drum, facet surfaces, others. What it is can be changed
  /// at any time; lists_changed() must be called where particles may meet what
  /// they did not see before. See dem/engine_boundaries.h for planes, drum and
  /// facets.
  Boundary &add_boundary(std::unique_ptr<Boundary> boundary);
  std::span<const std::unique_ptr<Boundary>> boundaries() const;
  /// All lists of contacts are rebuilt in the next step.
  void lists_changed();
  /// Makes the scene periodic; lengths and centre are set before the first
  /// step, rates may change at any time. Throws std::invalid_argument on a
  /// length below 0.
  void set_periodic_cell(const Vec3 &centre, const Vec3 &length);
  const PeriodicCell &cell() const;
  /// Rates of the lengths of the periodic cell from now on [m/s].
  void set_cell_rate(const Vec3 &rate);

  /// One velocity Verlet step [s]. Velocities of planes and the motion of
  /// facet surfaces (already at the end of the step) are set before. Throws
  /// std::runtime_error where particles leap by a hundred radii: too long a
  /// step; OverlapStop where a contact is deeper than OverlapLimits::stop.
  void advance(double time_step);
  /// The same without the second half kick, which stays pending: the next step
  /// does it in one pass over the particles with its own first half. Until then
  /// velocities and spins are half a step late, and the const functions that
  /// show them throw. All bits are those of advance().
  void advance_deferred(double time_step);
  /// Finishes the half kick that advance_deferred() has left pending, if any.
  /// Non-const functions that need it do this themselves. On many ranks
  /// particles that were added since the last step go to their owners, which is
  /// collective.
  void synchronize();

  /// Loads of all contacts as the scene was placed, before its first step:
  /// nothing moves. Dashpots see the velocities; tangential and rolling springs
  /// start at zero and take up the motion of `time_step` [s]. To inspect
  /// one contact see dem/measure/single_contact.h. Throws std::logic_error once
  /// lists of contacts are there, and on many ranks.
  void evaluate(double time_step);

  const EngineParameters &parameters() const;
  void set_friction(double friction);
  void set_local_damping(double damping);
  /// How soon contacts and lists are renewed, as GeometryParameters has it; the
  /// lists from the next ones on.
  void set_renewal(double refresh_tolerance, double skin);
  /// From now on a particle that has come through a wall does not stop the
  /// engine, nor does an overlap above OverlapLimits::stop: of rough packings,
  /// whose overlaps may push some out.
  void allow_escape();
  /// Takes all velocity from the particles; booked as damping.
  void come_to_rest();
  /// Whether particles break from now on; off: no damage grows either.
  void set_breaking(bool is_on);
  /// Of the rises of energy, as BreakageParameters::repetitions [-], of the
  /// load that begins now: what contacts have borne before counts no longer.
  void set_repetitions(double repetitions);

  /// Of this rank, and behind them ghosts. As they are at time(). The const one
  /// throws std::logic_error while a half kick is pending, as energy() and
  /// save() do.
  const ParticleSystem &particles() const;
  ParticleSystem &particles();
  const ContactBatch &pairs() const;

  double time() const;        ///< [s]
  void set_time(double time); ///< of the clock alone [s]
  std::int64_t n_steps() const;
  std::int64_t n_rebuilds() const;
  /// All that is nearer than this to each other is listed [m].
  double listed_gap() const;
  /// What this rank shares with others; see dem/parallel/distribution.h.
  const Distribution &distribution() const;
  /// Every so many rebuilds after which particles change their ranks the boxes
  /// of the ranks are made again, however well the loads are balanced; 0: where
  /// they are not.
  void set_partition_interval(std::int64_t interval);
  /// Of contacts that follow the true surfaces, since construction.
  const ContactPointEvents &contact_point_events() const;
  EngineEnergy energy() const;
  EngineClock clock() const;
  const OverlapRecord &overlaps() const;
  /// OverlapRecord::recent begins again.
  void begin_overlap_interval();
  /// Events since the last call.
  std::vector<BreakageEvent> take_events();
  std::int64_t n_events() const;
  int n_refused_events() const;

  /// A copy of the scene of all ranks on the first of them, in the order of the
  /// ids: the same bits on any number of ranks. The copies of other ranks have
  /// no particles. Throws std::logic_error while a half kick is pending.
  /// Collective.
  Engine gathered() const;
  /// Puts the scene of one rank in that order. Throws std::logic_error on many
  /// ranks.
  void order_by_id();

  /// Whether the scene can be spread over ranks: no periodic cell, no boundary
  /// or model that one rank alone can have.
  bool is_shareable() const;
  /// Full state, bit for bit, into a stream, see StateExtent; restore() on an
  /// engine with the same parameters and shared shapes (`library`, in order).
  /// Throws std::logic_error while a half kick is pending,
  /// std::invalid_argument where StateExtent::scene is asked of a scene that is
  /// not is_shareable(). Collective.
  void save(std::ostream &out,
            const std::vector<std::shared_ptr<const Coefficients>> &library,
            StateExtent extent = StateExtent::rank) const;
  /// Throws std::runtime_error if the stream does not fit. Collective.
  void restore(std::istream &in,
               const std::vector<std::shared_ptr<const Coefficients>> &library);

private:
  explicit Engine(std::unique_ptr<EngineState> state);

  std::unique_ptr<EngineState> state;
};
} // namespace dem
