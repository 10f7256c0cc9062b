#include <coupling/exchange.h>
#include <dem/boundary/surface_guard.h>
#include <dem/engine_boundaries.h>
#include <dem/parallel/distribution.h>
#include <dem/parallel/faults.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <utility>

namespace coupling
{
namespace
{
using Vector = Eigen::Vector3d;

template <class Work>
void timed(double &phase, const Work &work)
{
  using Clock = std::chrono::steady_clock;
  const auto start = Clock::now();
  work();
  phase += std::chrono::duration<double>(Clock::now() - start).count();
}

std::string text_of(double value)
{
  std::ostringstream text;
  text.precision(4);
  text << value;
  return text.str();
}

void require(bool condition, const std::string &what)
{
  if (!condition)
    throw std::invalid_argument("exchange: " + what);
}

template <class State>
std::string saved_state(const State &state)
{
  std::ostringstream out(std::ios::binary);
  state.save(out);
  return std::move(out).str();
}

template <class State>
void restore_state(const std::string &from, State &state)
{
  std::istringstream in(from, std::ios::binary);
  state.restore(in);
}

/// Passes that no longer come nearer: where the force of a contact jumps, as it
/// touches or begins to slide, motion and loads need not agree at all.
class Stall
{
public:
  /// Whether to stop at this gap: one of the best, after some without progress.
  bool is_over(double gap)
  {
    if (!std::isfinite(gap))
      return true;
    n_without = gap < 0.98 * best ? 0 : n_without + 1;
    best = std::min(best, gap);
    return n_without >= 4 && gap <= 1.5 * best;
  }

private:
  double best = std::numeric_limits<double>::infinity();
  int n_without = 0;
};

Field copy_of(FieldView field)
{
  return {field.begin(), field.end()};
}

Vector sum_of(FieldView field)
{
  Vector sum = Vector::Zero();
  for (const Vector &entry : field)
    sum += entry;
  return sum;
}
} // namespace

CoupledParticles particles_of(dem::Engine &engine, const ShapeLibrary &library)
{
  return {engine,
          [&engine](double time_step) { engine.advance_deferred(time_step); },
          [&](std::ostream &out) { engine.save(out, library); },
          [&](std::istream &in) { engine.restore(in, library); }};
}

Exchange::Exchange(const ExchangeParameters &p)
    : parameters(p), length(p.particle_steps)
{
  require(p.particle_steps >= 1,
          "particle steps per window must be at least 1");
  require(p.rule != ExchangeRule::every_step || p.particle_steps == 1,
          "every_step has windows of one step of the particles");
  require(p.rule != ExchangeRule::every_step || !p.has_contact_tangent,
          "every_step needs no tangent of the contacts");
  require(p.window_tolerance == 0. || p.rule == ExchangeRule::one_pass,
          "windows adapt with one_pass alone");
  length.follow(p.window_tolerance);
  require(p.relaxation.factor > 0. && p.relaxation.lowest > 0. &&
              p.relaxation.highest >= p.relaxation.lowest,
          "relaxation factors must be positive");
  require(p.tolerance > 0. && p.max_passes >= 1,
          "tolerance and passes must be positive");
}

DeformableBody &Exchange::add(std::unique_ptr<DeformableBody> body,
                              const fem::SurfaceMesh &mesh,
                              const std::string &name,
                              const dem::WallMaterial &contact,
                              ParticleSide side, dem::Engine &engine)
{
  InterfaceMap map(mesh, side);
  dem::FacetSurface surface =
      map.make_surface(body->motion(), body->nodal_mass());
  const std::size_t number =
      dem::add_surface(engine, name, contact, std::move(surface));
  return add(std::move(body),
             std::make_unique<FacetAdapter>(std::move(map), number), engine);
}

DeformableBody &Exchange::add(std::unique_ptr<DeformableBody> body,
                              std::unique_ptr<InterfaceAdapter> adapter,
                              const dem::Engine &engine)
{
  require(parameters.rule != ExchangeRule::every_step ||
              (!body->is_implicit() && body->n_steps() == 1),
          "every_step is for bodies with one explicit step");
  require(!parameters.has_contact_tangent || body->n_steps() == 1,
          "the tangent of the contacts is for bodies with one step in a "
          "window");
  const Field at = copy_of(body->motion().position);
  coupled_bodies.push_back({std::move(body), std::move(adapter), at, at,
                            Field(at.size(), Vector::Zero()),
                            parameters.has_contact_tangent ? at : Field()});
  CoupledBody &coupled = coupled_bodies.back();
  coupled.adapter->collect(engine, Collected::load, coupled.load);
  return *coupled.body;
}

std::size_t Exchange::coupled_body_of(const DeformableBody &body) const
{
  const auto found =
      std::ranges::find_if(coupled_bodies, [&](const CoupledBody &coupled)
                           { return coupled.body.get() == &body; });
  require(found != coupled_bodies.end(), "a body of another exchange");
  return static_cast<std::size_t>(found - coupled_bodies.begin());
}

void Exchange::hold(const DeformableBody &body, bool is_held)
{
  coupled_bodies[coupled_body_of(body)].is_held = is_held;
}

FieldView Exchange::load_on(const DeformableBody &body) const
{
  return coupled_bodies[coupled_body_of(body)].load;
}

void Exchange::advance(const CoupledParticles &particles, double window)
{
  struct AtTheEnd
  {
    dem::Engine &engine;
    ~AtTheEnd() { engine.synchronize(); } // also where a guard stops
  };
  const AtTheEnd synchronized{particles.engine};
  advance_deferred(particles, window);
}

void Exchange::advance_deferred(const CoupledParticles &particles,
                                double window)
{
  open_books(particles.engine);
  if (parameters.rule == ExchangeRule::every_step)
    step_together(particles, window);
  else
    pass_window(particles, window);
  close_books(particles.engine, window);
  ++window_count;
  step_count += length.steps();
  if (length.is_due(window_count))
    length.update(gain(particles.engine, window) / gain_limit, books,
                  window_count);
  check_gap(particles.engine.time());
  check_ledger(particles.engine.time());
  check_surfaces(particles.engine);
}

void Exchange::step_together(const CoupledParticles &particles,
                             double time_step)
{
  timed(spent.bodies,
        [&]
        {
          for (CoupledBody &coupled : coupled_bodies)
            if (!coupled.is_held)
              coupled.body->begin_step(time_step);
        });
  timed(spent.transfer,
        [&]
        {
          for (CoupledBody &coupled : coupled_bodies)
            coupled.adapter->place(coupled.body->motion(), particles.engine);
        });
  particles.advance(time_step);
  timed(spent.transfer,
        [&]
        {
          for (CoupledBody &coupled : coupled_bodies)
            coupled.adapter->collect(particles.engine, Collected::load,
                                     coupled.load);
        });
  timed(spent.bodies,
        [&]
        {
          for (CoupledBody &coupled : coupled_bodies)
            if (!coupled.is_held)
              coupled.body->end_step(coupled.load, time_step);
        });
  report = {1, 0.};
  ++pass_count;
}

void Exchange::pass_window(const CoupledParticles &particles, double window)
{
  particles.engine.synchronize(); // its state may be saved
  const bool may_repeat = parameters.rule == ExchangeRule::iterated;
  std::vector<std::string> start;
  std::ostringstream particles_then(std::ios::binary);
  timed(spent.keeping,
        [&]
        {
          for (const CoupledBody &coupled : coupled_bodies)
            start.push_back(saved_state(*coupled.body));
          if (!may_repeat)
            return;
          const auto events = particles.engine.take_events();
          held_events.insert(held_events.end(), events.begin(), events.end());
          particles.save(particles_then);
        });
  std::vector<Relaxation> relaxation(coupled_bodies.size(),
                                     Relaxation(parameters.relaxation));
  Stall stalled;
  predict(particles.engine, window);
  for (report.passes = 1;; ++report.passes)
  {
    run_particles(particles, window);
    report.gap = correct_bodies(start, particles.engine, window);
    if (!may_repeat || report.gap <= parameters.tolerance)
      break;
    if (report.passes == parameters.max_passes || stalled.is_over(report.gap))
    {
      ++unsettled_count;
      break;
    }
    for (std::size_t j = 0; j < coupled_bodies.size(); ++j)
    {
      CoupledBody &coupled = coupled_bodies[j];
      Field residual = copy_of(coupled.body->motion().position);
      for (std::size_t k = 0; k < residual.size(); ++k)
        residual[k] -= coupled.target[k];
      relaxation[j].correct(residual, coupled.target);
    }
    timed(spent.keeping,
          [&]
          {
            std::istringstream in(particles_then.str(), std::ios::binary);
            particles.restore(in);
          });
  }
  pass_count += report.passes;
  for (CoupledBody &coupled : coupled_bodies)
  {
    if (parameters.has_contact_tangent)
      coupled.from = coupled.at;
    coupled.at = coupled.target;
  }
}

void Exchange::check_gap(double time) const
{
  // No number at all is beyond every limit.
  if (parameters.rule == ExchangeRule::iterated &&
      !(report.gap <= std::max(parameters.tolerance, parameters.gap_limit)))
    throw GuardStop(
        "coupling: after " + std::to_string(report.passes) + " passes at " +
        text_of(time) + " s the bodies are " + text_of(report.gap) +
        " m from where the particles saw them, limit " +
        text_of(parameters.gap_limit) +
        " m: a shorter window, a smaller relaxation or more passes may help");
}

/// Where the bodies come to if the loads stay, or give way to the contacts.
void Exchange::predict(const dem::Engine &engine, double window)
{
  timed(spent.bodies,
        [&]
        {
          for (CoupledBody &coupled : coupled_bodies)
          {
            if (!coupled.is_held && find_tangent(coupled, engine, window))
              predict_with_tangent(coupled, window);
            else if (!coupled.is_held)
              coupled.body->advance(coupled.load, window);
            coupled.target = copy_of(coupled.body->motion().position);
          }
        });
}

/// Particles through the window, boundaries straight from `at` to `target`.
void Exchange::run_particles(const CoupledParticles &particles, double window)
{
  std::vector<Field> velocity;
  for (CoupledBody &coupled : coupled_bodies)
  {
    coupled.adapter->forget_impulse(particles.engine);
    Field &mean = velocity.emplace_back(coupled.at.size());
    for (std::size_t k = 0; k < mean.size(); ++k)
      mean[k] = (coupled.target[k] - coupled.at[k]) / window;
  }
  const int n = length.steps();
  Field position;
  for (int step = 1; step <= n; ++step)
  {
    timed(spent.transfer,
          [&]
          {
            for (std::size_t j = 0; j < coupled_bodies.size(); ++j)
            {
              position = coupled_bodies[j].target;
              const double left = window * (n - step) / n;
              for (std::size_t k = 0; k < position.size() && step < n; ++k)
                position[k] -= left * velocity[j][k];
              coupled_bodies[j].adapter->place({position, velocity[j]},
                                               particles.engine);
            }
          });
    particles.advance(window / n);
  }
  particles.engine.synchronize();
  timed(spent.transfer,
        [&]
        {
          for (CoupledBody &coupled : coupled_bodies)
          {
            coupled.adapter->collect(particles.engine, Collected::impulse,
                                     coupled.load);
            for (Vector &load : coupled.load)
              load /= window;
          }
        });
}

/// The bodies through the window again, with its mean loads; returns how far
/// they come from where the particles saw them.
double Exchange::correct_bodies(const std::vector<std::string> &start,
                                const dem::Engine &engine, double window)
{
  double gap = 0.;
  timed(spent.bodies,
        [&]
        {
          for (std::size_t j = 0; j < coupled_bodies.size(); ++j)
          {
            CoupledBody &coupled = coupled_bodies[j];
            if (coupled.is_held)
              continue;
            restore_state(start[j], *coupled.body);
            if (find_tangent(coupled, engine, window))
              correct_with_tangent(coupled, window);
            else
              coupled.body->advance(coupled.load, window);
            const FieldView now = coupled.body->motion().position;
            for (std::size_t k = 0; k < now.size(); ++k)
            {
              const double distance = (now[k] - coupled.target[k]).norm();
              gap =
                  std::isfinite(distance) ? std::max(gap, distance) : distance;
            }
          }
        });
  return gap;
}

void Exchange::open_books(const dem::Engine &engine)
{
  given_before.clear();
  taken_before.clear();
  load_before.clear();
  for (const CoupledBody &coupled : coupled_bodies)
  {
    given_before.push_back(coupled.adapter->sums(engine));
    taken_before.push_back(coupled.body->energy().load_work);
    load_before.push_back(coupled.load);
  }
}

/// The particles book impulses by the trapezoidal rule. With every_step the
/// bodies take the loads at both ends of the step, else the mean of the window.
void Exchange::close_books(const dem::Engine &engine, double window)
{
  const bool is_mean = parameters.rule != ExchangeRule::every_step;
  double work = 0.;
  Vector impulse = Vector::Zero();
  for (std::size_t j = 0; j < coupled_bodies.size(); ++j)
  {
    const CoupledBody &coupled = coupled_bodies[j];
    const InterfaceSums given = coupled.adapter->sums(engine);
    work += given.work - given_before[j].work;
    impulse += given.impulse;
    if (!is_mean) // else it was forgotten when the window began
      impulse -= given_before[j].impulse;
    books.taken += coupled.body->energy().load_work - taken_before[j];
    const Vector now = sum_of(coupled.load);
    books.impulse_taken +=
        window * (is_mean ? now : Vector(0.5 * (sum_of(load_before[j]) + now)));
  }
  books.given += work;
  books.moved += std::abs(work);
  books.impulse_given += impulse;
  books.impulse_moved += impulse.norm();
}

void Exchange::check_ledger(double time) const
{
  // Where hardly anything has crossed yet no share is meant.
  constexpr std::int64_t first_windows = 100;
  if (window_count > first_windows &&
      !(books.work_residual() <= parameters.ledger_limit))
    throw GuardStop("coupling: at " + text_of(time) +
                    " s the ledger is beyond Coupling/ledger_limit = " +
                    text_of(parameters.ledger_limit) + ": particles gave " +
                    text_of(books.given) + " J, bodies took " +
                    text_of(books.taken) + " J, " +
                    text_of(books.work_residual()) + " of all that crossed");
}

/// Between two rebuilds nothing moves farther than the skin of the lists.
/// Surfaces that crossed stay crossed for longer: checked less often.
void Exchange::check_surfaces(dem::Engine &engine)
{
  // Lists on surfaces may be renewed every few steps: not far enough for a
  // particle to get through.
  constexpr std::int64_t least_interval = 50;   // steps
  constexpr std::int64_t crossing_interval = 8; // checks
  if (engine.n_rebuilds() == surfaces_seen_at ||
      engine.n_steps() < next_surface_check)
    return;
  engine.synchronize();
  surfaces_seen_at = engine.n_rebuilds();
  next_surface_check = engine.n_steps() + least_interval;
  const bool checks_crossing = n_surface_checks++ % crossing_interval == 0;
  const auto check = [&](const dem::FacetBoundary &facets)
  {
    const auto words = [&](const std::optional<dem::SurfaceFault> &fault)
    {
      return fault ? "coupling: at " + text_of(engine.time()) +
                         " s in the surface '" + facets.label + "' " +
                         dem::describe(*fault)
                   : std::string();
    };
    // All ranks see the same surface, each its own particles.
    if (const auto fold = dem::find_fold(facets.mesh()))
      throw FoldStop(words(fold));
    dem::stop_together<GuardStop>(
        engine.distribution().ranks(),
        words(dem::find_left(facets, engine.particles(),
                             engine.parameters().geometry.wall_geometry)));
    if (!checks_crossing)
      return;
    if (const auto crossing = dem::find_crossing(facets.mesh()))
      throw FoldStop(words(crossing));
  };
  timed(spent.guards,
        [&]
        {
          for (const dem::FacetBoundary &facets : dem::surfaces(engine))
            check(facets);
        });
}

std::vector<dem::BreakageEvent> Exchange::take_events()
{
  return std::exchange(held_events, {});
}
} // namespace coupling
