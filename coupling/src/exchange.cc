#include <coupling/exchange.h>
#include <dem/boundary/surface_guard.h>
#include <dem/io/binary.h>

#include <algorithm>
#include <chrono>
#include <cmath>
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
std::string kept(const State &state)
{
  std::ostringstream out(std::ios::binary);
  state.save(out);
  return std::move(out).str();
}

template <class State>
void bring_back(const std::string &from, State &state)
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

Stones stones_of(dem::Engine &engine, const ShapeLibrary &library)
{
  return {engine,
          [&engine](double time_step) { engine.advance_unseen(time_step); },
          [&](std::ostream &out) { engine.save(out, library); },
          [&](std::istream &in) { engine.restore(in, library); }};
}

Exchange::Exchange(const ExchangeParameters &p)
    : parameters(p), length(p.stone_steps)
{
  require(p.stone_steps >= 1, "stone steps per window must be at least 1");
  require(p.rule != ExchangeRule::every_step || p.stone_steps == 1,
          "every_step has windows of one step of the stones");
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

Body &Exchange::add(std::unique_ptr<Body> body, const fem::SurfaceMesh &mesh,
                    const std::string &name, const dem::WallMaterial &contact,
                    StoneSide side, dem::Engine &engine)
{
  InterfaceMap map(mesh, side);
  dem::FacetSurface surface =
      map.make_surface(body->motion(), body->nodal_mass());
  const std::size_t number =
      engine.add_surface(name, contact, std::move(surface));
  return add(std::move(body),
             std::make_unique<FacetSeam>(std::move(map), number), engine);
}

Body &Exchange::add(std::unique_ptr<Body> body, std::unique_ptr<Seam> seam,
                    const dem::Engine &engine)
{
  require(parameters.rule != ExchangeRule::every_step ||
              (!body->is_implicit() && body->n_steps() == 1),
          "every_step is for bodies with one explicit step");
  require(!parameters.has_contact_tangent || body->n_steps() == 1,
          "the tangent of the contacts is for bodies with one step in a "
          "window");
  const Field at = copy_of(body->motion().position);
  joints.push_back({std::move(body), std::move(seam), at, at,
                    Field(at.size(), Vector::Zero()),
                    parameters.has_contact_tangent ? at : Field()});
  Joint &joint = joints.back();
  joint.seam->collect(engine, Collected::load, joint.load);
  return *joint.body;
}

std::size_t Exchange::joint_of(const Body &body) const
{
  const auto found = std::ranges::find_if(
      joints, [&](const Joint &joint) { return joint.body.get() == &body; });
  require(found != joints.end(), "a body that is none of its own");
  return static_cast<std::size_t>(found - joints.begin());
}

void Exchange::hold(const Body &body, bool is_held)
{
  joints[joint_of(body)].is_held = is_held;
}

FieldView Exchange::load_on(const Body &body) const
{
  return joints[joint_of(body)].load;
}

void Exchange::advance(const Stones &stones, double window)
{
  open_books(stones.engine);
  if (parameters.rule == ExchangeRule::every_step)
    step_together(stones, window);
  else
    pass_window(stones, window);
  close_books(stones.engine, window);
  ++window_count;
  step_count += length.steps();
  if (length.is_due(window_count))
    length.look(gain(stones.engine, window) / gain_limit, books, window_count);
  check_gap(stones.engine.time());
  check_ledger(stones.engine.time());
  check_surfaces(stones.engine);
}

void Exchange::step_together(const Stones &stones, double time_step)
{
  timed(spent.bodies,
        [&]
        {
          for (Joint &joint : joints)
            if (!joint.is_held)
              joint.body->begin_step(time_step);
        });
  timed(spent.transfer,
        [&]
        {
          for (Joint &joint : joints)
            joint.seam->place(joint.body->motion(), stones.engine);
        });
  stones.advance(time_step);
  timed(spent.transfer,
        [&]
        {
          for (Joint &joint : joints)
            joint.seam->collect(stones.engine, Collected::load, joint.load);
        });
  timed(spent.bodies,
        [&]
        {
          for (Joint &joint : joints)
            if (!joint.is_held)
              joint.body->end_step(joint.load, time_step);
        });
  report = {1, 0.};
  ++pass_count;
}

void Exchange::pass_window(const Stones &stones, double window)
{
  const bool may_repeat = parameters.rule == ExchangeRule::iterated;
  std::vector<std::string> start;
  std::ostringstream stones_then(std::ios::binary);
  timed(spent.keeping,
        [&]
        {
          for (const Joint &joint : joints)
            start.push_back(kept(*joint.body));
          if (!may_repeat)
            return;
          const auto events = stones.engine.take_events();
          held_events.insert(held_events.end(), events.begin(), events.end());
          stones.save(stones_then);
        });
  std::vector<Relaxation> relaxation(joints.size(),
                                     Relaxation(parameters.relaxation));
  Stall stalled;
  predict(stones.engine, window);
  for (report.passes = 1;; ++report.passes)
  {
    run_stones(stones, window);
    report.gap = correct_bodies(start, stones.engine, window);
    if (!may_repeat || report.gap <= parameters.tolerance)
      break;
    if (report.passes == parameters.max_passes || stalled.is_over(report.gap))
    {
      ++unsettled_count;
      break;
    }
    for (std::size_t j = 0; j < joints.size(); ++j)
    {
      Joint &joint = joints[j];
      Field residual = copy_of(joint.body->motion().position);
      for (std::size_t k = 0; k < residual.size(); ++k)
        residual[k] -= joint.target[k];
      relaxation[j].correct(residual, joint.target);
    }
    timed(spent.keeping,
          [&]
          {
            std::istringstream in(stones_then.str(), std::ios::binary);
            stones.restore(in);
          });
  }
  pass_count += report.passes;
  for (Joint &joint : joints)
  {
    if (parameters.has_contact_tangent)
      joint.from = joint.at;
    joint.at = joint.target;
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
        " m from where the stones saw them, limit " +
        text_of(parameters.gap_limit) +
        " m: a shorter window, a smaller relaxation or more passes may help");
}

/// Where the bodies come to if the loads stay, or give way to the contacts.
void Exchange::predict(const dem::Engine &engine, double window)
{
  timed(spent.bodies,
        [&]
        {
          for (Joint &joint : joints)
          {
            if (!joint.is_held && find_tangent(joint, engine, window))
              predict_with_tangent(joint, window);
            else if (!joint.is_held)
              joint.body->advance(joint.load, window);
            joint.target = copy_of(joint.body->motion().position);
          }
        });
}

/// Stones through the window, boundaries straight from `at` to `target`.
void Exchange::run_stones(const Stones &stones, double window)
{
  std::vector<Field> velocity;
  for (Joint &joint : joints)
  {
    joint.seam->forget_impulse(stones.engine);
    Field &mean = velocity.emplace_back(joint.at.size());
    for (std::size_t k = 0; k < mean.size(); ++k)
      mean[k] = (joint.target[k] - joint.at[k]) / window;
  }
  const int n = length.steps();
  Field position;
  for (int step = 1; step <= n; ++step)
  {
    timed(spent.transfer,
          [&]
          {
            for (std::size_t j = 0; j < joints.size(); ++j)
            {
              position = joints[j].target;
              const double left = window * (n - step) / n;
              for (std::size_t k = 0; k < position.size() && step < n; ++k)
                position[k] -= left * velocity[j][k];
              joints[j].seam->place({position, velocity[j]}, stones.engine);
            }
          });
    stones.advance(window / n);
  }
  timed(spent.transfer,
        [&]
        {
          for (Joint &joint : joints)
          {
            joint.seam->collect(stones.engine, Collected::impulse, joint.load);
            for (Vector &load : joint.load)
              load /= window;
          }
        });
}

/// The bodies through the window again, with its mean loads; returns how far
/// they come from where the stones saw them.
double Exchange::correct_bodies(const std::vector<std::string> &start,
                                const dem::Engine &engine, double window)
{
  double gap = 0.;
  timed(spent.bodies,
        [&]
        {
          for (std::size_t j = 0; j < joints.size(); ++j)
          {
            Joint &joint = joints[j];
            if (joint.is_held)
              continue;
            bring_back(start[j], *joint.body);
            if (find_tangent(joint, engine, window))
              correct_with_tangent(joint, window);
            else
              joint.body->advance(joint.load, window);
            const FieldView now = joint.body->motion().position;
            for (std::size_t k = 0; k < now.size(); ++k)
            {
              const double distance = (now[k] - joint.target[k]).norm();
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
  for (const Joint &joint : joints)
  {
    given_before.push_back(joint.seam->sums(engine));
    taken_before.push_back(joint.body->energy().load_work);
    load_before.push_back(joint.load);
  }
}

/// The stones book impulses by the trapezoidal rule. With every_step the bodies
/// take the loads at both ends of the step, else the mean of the window.
void Exchange::close_books(const dem::Engine &engine, double window)
{
  const bool is_mean = parameters.rule != ExchangeRule::every_step;
  double work = 0.;
  Vector impulse = Vector::Zero();
  for (std::size_t j = 0; j < joints.size(); ++j)
  {
    const Joint &joint = joints[j];
    const SeamSums given = joint.seam->sums(engine);
    work += given.work - given_before[j].work;
    impulse += given.impulse;
    if (!is_mean) // else it was forgotten when the window began
      impulse -= given_before[j].impulse;
    books.taken += joint.body->energy().load_work - taken_before[j];
    const Vector now = sum_of(joint.load);
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
                    text_of(parameters.ledger_limit) + ": stones gave " +
                    text_of(books.given) + " J, bodies took " +
                    text_of(books.taken) + " J, " +
                    text_of(books.work_residual()) + " of all that crossed");
}

/// Between two rebuilds nothing moves farther than the margin of the lists.
/// What has crossed stays so for longer: it is looked for less often.
void Exchange::check_surfaces(const dem::Engine &engine)
{
  if (engine.n_rebuilds() == surfaces_seen_at)
    return;
  surfaces_seen_at = engine.n_rebuilds();
  constexpr std::int64_t crossing_interval = 8; // rebuilds
  const auto look = [&](const dem::SurfaceContacts &facets)
  {
    auto fault = dem::find_fold(facets.mesh());
    if (!fault)
      fault = dem::find_left(facets, engine.particles(),
                             engine.parameters().geometry.wall_geometry);
    if (!fault && surfaces_seen_at % crossing_interval == 0)
      fault = dem::find_crossing(facets.mesh());
    if (!fault)
      return;
    const std::string what = "coupling: at " + text_of(engine.time()) +
                             " s in the surface '" + facets.name + "' " +
                             dem::describe(*fault);
    if (fault->flaw == dem::SurfaceFlaw::left)
      throw GuardStop(what);
    throw FoldStop(what);
  };
  timed(spent.guards,
        [&]
        {
          for (const dem::SurfaceContacts &facets : engine.surfaces())
            look(facets);
        });
}

std::vector<dem::BreakageEvent> Exchange::take_events()
{
  return std::exchange(held_events, {});
}

void Exchange::save(std::ostream &out) const
{
  for (const Joint &joint : joints)
  {
    joint.body->save(out);
    dem::write_column(out, joint.at);
    dem::write_column(out, joint.load);
    dem::write_column(out, joint.from);
  }
  dem::write_value(out, books);
  dem::write_value(out, pass_count);
  dem::write_value(out, window_count);
  dem::write_value(out, unsettled_count);
  dem::write_value(out, step_count);
  dem::write_value(out, length);
}

void Exchange::restore(std::istream &in)
{
  held_events.clear(); // of windows that have not been
  for (Joint &joint : joints)
  {
    joint.body->restore(in);
    dem::read_column(in, joint.at);
    dem::read_column(in, joint.load);
    dem::read_column(in, joint.from);
  }
  dem::read_value(in, books);
  dem::read_value(in, pass_count);
  dem::read_value(in, window_count);
  dem::read_value(in, unsettled_count);
  dem::read_value(in, step_count);
  dem::read_value(in, length);
}
} // namespace coupling
