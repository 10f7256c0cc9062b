#pragma once

#include <coupling/deformable_body.h>
#include <coupling/interface_adapter.h>
#include <coupling/ledger.h>
#include <coupling/relaxation.h>
#include <coupling/window_length.h>

#include <functional>
#include <memory>
#include <stdexcept>
#include <string>

namespace coupling
{
enum class ExchangeRule : std::int64_t
{
  every_step, ///< one explicit step of all together, no lag
  one_pass, ///< particles follow bodies that are predicted with the last loads
  iterated  ///< until motion and loads of the window agree
};

struct ExchangeParameters
{
  ExchangeRule rule = ExchangeRule::every_step;
  int particle_steps = 1; ///< of the particles in one window, at most [-]
  /// one_pass: windows are shorter where more than this share of the exchanged
  /// work is lost, or the gain requires it; 0: all are of one length [-].
  double window_tolerance = 0.;
  /// The stiffness of contacts enters the implicit steps of bodies that take
  /// it; in windows, with one step of the body.
  bool has_contact_tangent = false;
  RelaxationParameters relaxation;
  double tolerance =
      1e-9; ///< gap between body and what particles saw of it [m]
  /// After so many, or once they come no nearer, the last pass counts if its
  /// gap is small enough: where the force of a contact jumps nothing need
  /// agree.
  int max_passes = 30;
  double gap_limit = 1e-5; ///< then [m]
  /// Largest share of the exchanged work that may be lost [-].
  double ledger_limit = std::numeric_limits<double>::infinity();
};

/// The side of the particles, with all that steps along with them: what an
/// iteration must undo. save and restore are for the rule iterated only; on
/// many ranks both are collective.
struct CoupledParticles
{
  dem::Engine &engine;
  std::function<void(double time_step)> advance;
  std::function<void(std::ostream &)> save;
  std::function<void(std::istream &)> restore;
};

using ShapeLibrary = std::vector<std::shared_ptr<const dem::Coefficients>>;

/// An engine alone; `library` as for Engine::save, kept by the caller.
CoupledParticles particles_of(dem::Engine &engine, const ShapeLibrary &library);

/// A guard stops the run: the state is whole, at the end of a window.
class GuardStop : public std::runtime_error
{
  using std::runtime_error::runtime_error;
};

/// As a surface has folded or runs through itself.
class FoldStop : public GuardStop
{
  using GuardStop::GuardStop;
};

/// Wall-clock spent in the bodies, in keeping and undoing the rest, and in
/// looking at the surfaces [s].
struct ExchangeClock
{
  double bodies = 0., transfer = 0., keeping = 0., guards = 0.;
};

/// How the last window went.
struct WindowReport
{
  int passes = 0;  ///< of the particles
  double gap = 0.; ///< left between bodies and what particles saw of them [m]
};

/// Takes particles and bodies through time together, window by window. In a
/// window the boundaries move straight and evenly to where the bodies are
/// expected; the mean load over the window, impulse over length, then moves the
/// bodies from its start to its end (docs/theory/interface.md). Where the
/// particles are spread over ranks, every rank has all bodies and moves them in
/// the same way.
class Exchange
{
public:
  /// Throws std::invalid_argument on parameters that make no sense.
  explicit Exchange(const ExchangeParameters &parameters);

  /// Adds a body whose nodes all are a facet surface of the engine.
  DeformableBody &add(std::unique_ptr<DeformableBody> body,
                      const fem::SurfaceMesh &mesh, const std::string &name,
                      const dem::WallMaterial &contact, ParticleSide side,
                      dem::Engine &engine);
  /// Adds a body with its own adapter. Throws std::invalid_argument on an
  /// implicit body with the rule every_step.
  DeformableBody &add(std::unique_ptr<DeformableBody> body,
                      std::unique_ptr<InterfaceAdapter> adapter,
                      const dem::Engine &engine);

  /// A body that is held stays where it is, whatever loads it, until it is let
  /// go. Not part of what is saved. Throws std::invalid_argument if it is none
  /// of the exchange.
  void hold(const DeformableBody &body, bool is_held);

  /// Mean load of the particles on the nodes of a body in the last window, with
  /// every_step at its end [N]. Throws std::invalid_argument as hold.
  FieldView load_on(const DeformableBody &body) const;

  /// Of the particles in the next window.
  int particle_steps() const { return length.steps(); }
  /// With window_tolerance: at most so many, and by this limit of the gain of
  /// one pass (WindowGain) [-].
  void limit_windows(int particle_steps, double limit_of_gain);

  /// One window of so many steps [s]. Throws GuardStop after it when passes
  /// have left too large a gap, the ledger is beyond its limit, or (checked
  /// whenever the lists of the particles were rebuilt) a surface is folded,
  /// runs through itself or has let a particle out.
  void advance(const CoupledParticles &particles, double window);
  /// The same, but with every_step the last half kick of the particles may stay
  /// pending, as after dem::Engine::advance_deferred().
  void advance_deferred(const CoupledParticles &particles, double window);

  /// One step in which the particles meet a body that has been put where it is
  /// now, and came there with these velocities [m/s]; what they do to it does
  /// not move it. In no ledger. Throws std::invalid_argument as hold.
  void follow(const DeformableBody &body, FieldView velocity,
              const CoupledParticles &particles, double time_step);

  /// k dt^2 / (4 m) of the present contacts, at most: of every node with all
  /// that press on it (docs/theory/windows.md). Collective [-].
  double gain(const dem::Engine &engine, double window) const;
  /// dem::contact_springs() with the nodes as points; in windows, where bodies
  /// move as prescribed, with walls instead. The facet surfaces of the
  /// engine are those of the bodies, in their order.
  dem::SpringNetwork springs(const dem::Engine &engine, double horizon) const;
  ExchangeRule rule() const { return parameters.rule; }
  /// With it one pass has no limit of its own.
  bool has_contact_tangent() const { return parameters.has_contact_tangent; }

  const LedgerSums &ledger() const { return books; }
  const WindowReport &last_window() const { return report; }
  std::int64_t n_passes() const { return pass_count; }
  std::int64_t n_windows() const { return window_count; }
  std::int64_t n_particle_steps() const { return step_count; } ///< in them
  /// Windows that were left with a gap above the tolerance.
  std::int64_t n_unsettled() const { return unsettled_count; }
  ExchangeClock clock() const { return spent; }
  /// Breakage events that the engine had before a window was repeated.
  std::vector<dem::BreakageEvent> take_events();

  void save(std::ostream &out) const; ///< bit for bit, bodies included
  void restore(std::istream &in);     ///< std::runtime_error

private:
  struct CoupledBody
  {
    std::unique_ptr<DeformableBody> body;
    std::unique_ptr<InterfaceAdapter> adapter;
    Field at;     ///< where particles see it [m]
    Field target; ///< where they will see it at the end of the window [m]
    Field load;   ///< mean of the last window, or of the end of step [N]
    Field from;   ///< with contact tangent: `at` one window ago [m]
    bool is_held = false;
    ContactTangent tangent = {};   ///< space to work in
    fem::NodeSprings springs = {}; ///< the same
  };
  std::size_t coupled_body_of(const DeformableBody &body) const;

  void step_together(const CoupledParticles &particles, double time_step);
  void pass_window(const CoupledParticles &particles, double window);
  void predict(const dem::Engine &engine, double window);
  bool find_tangent(CoupledBody &coupled, const dem::Engine &engine,
                    double window) const;
  void predict_with_tangent(CoupledBody &coupled, double window) const;
  void correct_with_tangent(CoupledBody &coupled, double window) const;
  void run_particles(const CoupledParticles &particles, double window);
  double correct_bodies(const std::vector<std::string> &start,
                        const dem::Engine &engine, double window);
  void open_books(const dem::Engine &engine);
  void close_books(const dem::Engine &engine, double window);
  void check_ledger(double time) const;
  void check_gap(double time) const;
  void check_surfaces(dem::Engine &engine);

  ExchangeParameters parameters;
  WindowLength length;
  double gain_limit = 1. / 3.; ///< for it [-]
  std::vector<CoupledBody> coupled_bodies;
  LedgerSums books;
  WindowReport report;
  std::int64_t pass_count = 0, window_count = 0, unsettled_count = 0;
  std::int64_t step_count = 0;
  std::int64_t surfaces_seen_at = -1;  ///< rebuilds of the lists then
  std::int64_t next_surface_check = 0; ///< not before this step of the engine
  std::int64_t n_surface_checks = 0;
  std::vector<dem::BreakageEvent> held_events;
  ExchangeClock spent;
  std::vector<InterfaceSums> given_before;
  std::vector<double> taken_before;
  std::vector<Field> load_before;
};
} // namespace coupling
