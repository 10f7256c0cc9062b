#include "solid_state.h"

#include <stdexcept>

namespace fem
{
namespace
{
using Vector = Eigen::Vector3d;

bool operator==(const SystemWeights &a, const SystemWeights &b)
{
  return a.mass == b.mass && a.dashpot == b.dashpot &&
         a.stiffness == b.stiffness;
}
} // namespace

void Solid::State::solve(const SystemWeights &weights, NodeField &field)
{
  const int version = supports.version() + n_dashpot_changes;
  if (kept.version != version || !(kept.weights == weights))
  {
    kept.factor.reset(); // its memory first
    kept.multigrid.reset();
    kept.version = -1;
    if (parameters.solver == SolidSolver::direct)
      kept.factor.emplace(assemble(parts(), weights));
    else
      kept.multigrid.emplace(parts(), weights,
                             parameters.solver == SolidSolver::distributed_amg
                                 ? MultigridSolver::Spread::all_ranks
                                 : MultigridSolver::Spread::one_rank);
    kept.weights = weights;
    kept.version = version;
  }
  const Eigen::VectorXd right = to_unknowns(supports, field);
  from_unknowns(supports,
                kept.factor
                    ? Eigen::VectorXd(kept.factor->solve(right))
                    : kept.multigrid->solve(right, parameters.solver_tolerance),
                field);
}

int Solid::solver_iterations() const
{
  return state->kept.multigrid ? state->kept.multigrid->n_iterations() : 0;
}

/// From the balance of forces now; fixed and hanging nodes have none.
void Solid::State::start_accelerations()
{
  for (std::size_t k = 0; k < mass.size(); ++k)
    for (int c = 0; c < 3; ++c)
      now.acceleration[k](c) =
          supports.unknown(k, c) < 0
              ? 0.
              : (force(k) - dashpot[k] * now.velocity[k])(c) / mass[k];
  now.has_acceleration = true;
}

/// K (end (u + beta v) + (1 - end) (u_0 + beta v_0)) [N]: elastic and viscous
/// force at the time where the rule takes them, less what has flown until now.
NodeField Solid::State::mixed_force(const NodeField &start,
                                    const NodeField &speed, double end) const
{
  const double beta = parameters.stiffness_damping;
  NodeField mixed(mass.size()), result(mass.size());
  for (std::size_t k = 0; k < mass.size(); ++k)
    mixed[k] = end * (now.displacement[k] + beta * now.velocity[k]) +
               (1. - end) * (start[k] + beta * speed[k]);
  supports.spread(mixed);
  multiply(mixed, result);
  relieve(result);
  return result;
}

/// New accelerations from the predicted motion in `now` and the old one.
void Solid::State::solve_accelerations(const ImplicitStep &step,
                                       const NodeField &start,
                                       const NodeField &speed)
{
  const double end = 1. - step.rule.alpha_f;
  const double beta = parameters.stiffness_damping;
  const SystemWeights system{
      1. - step.rule.alpha_m, end * step.rule.gamma * step.time_step,
      end * (step.rule.beta * step.time_step + beta * step.rule.gamma) *
          step.time_step};
  const NodeField internal = mixed_force(start, speed, end);
  NodeField load(step.load.begin(), step.load.end());
  supports.collect(load);
  for (std::size_t k = 0; k < mass.size(); ++k)
    load[k] =
        end * load[k] + step.rule.alpha_f * now.load[k] -
        step.rule.alpha_m * mass[k] * now.acceleration[k] -
        dashpot[k] * (end * now.velocity[k] + step.rule.alpha_f * speed[k]) -
        internal[k];
  solve(system, load);
  for (std::size_t k = 0; k < mass.size(); ++k)
    for (int c = 0; c < 3; ++c)
      if (supports.unknown(k, c) >= 0)
        now.acceleration[k](c) = load[k](c);
  if (is_linear())
    return;
  const double reach = step.rule.beta * step.time_step * step.time_step;
  NodeField predicted = now.displacement;
  for (std::size_t k = 0; k < mass.size(); ++k)
    predicted[k] += reach * now.acceleration[k];
  supports.spread(predicted);
  const NodeField change = flow_correction({&predicted, system, reach, end});
  for (std::size_t k = 0; k < mass.size(); ++k)
    now.acceleration[k] += change[k];
}

void Solid::advance(std::span<const Vector> load, double time_step,
                    const ImplicitRule &rule)
{
  check_solid_step(time_step);
  check_solid_loads(load.size(), state->mass.size());
  SolidMotion &now = state->now;
  state->put_supports_in_motion();
  if (!now.has_acceleration)
    state->start_accelerations();

  // Predicted without the new accelerations; the matrix adds their share.
  const NodeField start = now.displacement, speed = now.velocity;
  for (std::size_t k = 0; k < start.size(); ++k)
  {
    now.displacement[k] +=
        time_step *
        (speed[k] + (0.5 - rule.beta) * time_step * now.acceleration[k]);
    now.velocity[k] += (1. - rule.gamma) * time_step * now.acceleration[k];
  }
  state->solve_accelerations({load, time_step, rule}, start, speed);

  NodeField end_speed = now.velocity;
  for (std::size_t k = 0; k < start.size(); ++k)
  {
    now.displacement[k] +=
        rule.beta * time_step * time_step * now.acceleration[k];
    end_speed[k] += rule.gamma * time_step * now.acceleration[k];
    now.moved[k] = now.displacement[k] - start[k];
  }
  now.velocity = speed; // the forces at the start do their half of the work
  state->book_half_step();
  now.velocity = end_speed;
  state->supports.spread(now.displacement);
  state->supports.spread(now.velocity);
  state->set_load(load);
  state->update_forces();
  state->book_half_step();
}

/// Displacements of equilibrium with the supports where they are put.
NodeField Solid::State::equilibrium(std::span<const Vector> load)
{
  const std::size_t n = mass.size();
  NodeField target = now.displacement, internal(n);
  for (std::size_t k = 0; k < n; ++k)
    for (int c = 0; c < 3; ++c)
      if (supports.is_fixed(k, c))
        target[k](c) = now.support_displacement[k](c);
  supports.spread(target);
  multiply(target, internal);
  relieve(internal);
  NodeField residual(load.begin(), load.end());
  supports.collect(residual);
  for (std::size_t k = 0; k < n; ++k)
    residual[k] -= internal[k];
  solve({0., 0., 1.}, residual);
  for (std::size_t k = 0; k < n; ++k)
    for (int c = 0; c < 3; ++c)
      if (supports.unknown(k, c) >= 0)
        target[k](c) += residual[k](c);
  supports.spread(target);
  if (is_linear())
    return target;
  const NodeField change = flow_correction({&target, {0., 0., 1.}, 1., 1.});
  for (std::size_t k = 0; k < n; ++k)
    target[k] += change[k];
  return target;
}

void Solid::State::settle(std::span<const Vector> load)
{
  const NodeField end = equilibrium(load);
  const std::size_t n = end.size();
  for (std::size_t k = 0; k < n; ++k) // brought to rest
    now.done.damping += 0.5 * mass[k] * now.velocity[k].squaredNorm();
  now.velocity.assign(n, Vector::Zero());
  now.acceleration = now.viscous = now.velocity;
  now.has_acceleration = true;
  for (std::size_t k = 0; k < n; ++k)
    now.moved[k] = end[k] - now.displacement[k];
  book_half_step();
  now.displacement = end;
  set_load(load);
  update_forces();
  book_half_step();
}

/// Where Newton's method does not get there at once, in parts of the load.
void Solid::settle(std::span<const Vector> load)
{
  check_solid_loads(load.size(), state->mass.size());
  constexpr int most_parts = 16;
  const SolidMotion before = state->now;
  NodeField part(load.size());
  for (int n = 1;; n *= 4)
    try
    {
      for (int step = 1; step <= n; ++step)
      {
        const double share = static_cast<double>(step) / n;
        for (std::size_t k = 0; k < part.size(); ++k)
          part[k] = (1. - share) * before.load[k] + share * load[k];
        state->settle(part);
      }
      return;
    }
    catch (const std::runtime_error &)
    {
      state->now = before;
      if (state->is_linear() || n == most_parts)
        throw;
    }
}

void Solid::start_under(std::span<const Vector> load)
{
  check_solid_loads(load.size(), state->mass.size());
  if (!state->hyper.empty())
    throw std::invalid_argument("solid: layers at finite strains cannot start "
                                "under a load");
  if (state->plastic.empty())
    return;
  const SolidMotion before = state->now;
  settle(load);
  const std::vector<Voigt> carried = state->now.plastic.stress;
  state->now = before;
  state->plastic.add_initial_stress(carried);
}

std::span<const double> Solid::newton_residuals() const
{
  return state->newton_residuals;
}
} // namespace fem
