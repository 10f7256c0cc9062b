#include "membrane_state.h"

#include <Eigen/Sparse>
#include <Eigen/SparseLU>

#include <cmath>
#include <stdexcept>

namespace fem
{
namespace
{
using Vector = Eigen::Vector3d;
using Matrix = Eigen::SparseMatrix<double>;

/// What moves a node of an element: the first of the three unknowns of a node,
/// and its weight.
using Shares = std::vector<std::pair<int, double>>;

/// Of every node: its own unknowns, those of the ends of its edge, or none.
std::vector<Shares> number_unknowns(std::span<const std::uint8_t> is_tied,
                                    const Followers &midpoints)
{
  std::vector<Shares> shares(is_tied.size());
  int n_free = 0;
  for (std::size_t k = 0; k < is_tied.size(); ++k)
    if (!is_tied[k] && !midpoints.is_hanging(k))
      shares[k] = {{3 * n_free++, 1.}};
  for (std::size_t k = 0; k < is_tied.size(); ++k)
    if (midpoints.is_hanging(k))
      for (const auto &[end, weight] : midpoints.parents(k))
        if (const Shares &own = shares[static_cast<std::size_t>(end)];
            !own.empty())
          shares[k].emplace_back(own.front().first, weight);
  return shares;
}

void add_element(const SheetElement &element, const SheetTangent &tangent,
                 const std::vector<Shares> &shares,
                 std::vector<Eigen::Triplet<double>> &entries)
{
  const auto of_row = [&](int i) -> const Shares &
  {
    return shares[static_cast<std::size_t>(
        element.node[static_cast<std::size_t>(i / 3)])];
  };
  for (int row = 0; row < 12; ++row)
    for (int column = 0; column < 12; ++column)
      for (const auto &[r, of_r] : of_row(row))
        for (const auto &[c, of_c] : of_row(column))
          entries.emplace_back(r + row % 3, c + column % 3,
                               of_r * of_c * tangent(row, column));
}

double size(const std::vector<Vector> &field)
{
  double sum = 0.;
  for (const Vector &entry : field)
    sum += entry.squaredNorm();
  return std::sqrt(sum);
}
} // namespace

void Membrane::State::start_accelerations()
{
  for (std::size_t k = 0; k < mass.size(); ++k)
    now.acceleration[k] =
        is_free(k) ? Vector(force(k) / mass[k] -
                            parameters.mass_damping * now.velocity[k])
                   : Vector::Zero();
  midpoints.spread(now.acceleration);
  now.has_acceleration = 1;
}

std::vector<Vector> Membrane::State::residual(const MembraneStep &step) const
{
  std::vector<Vector> result(mass.size(), Vector::Zero());
  const double am = step.rule.alpha_m, af = step.rule.alpha_f;
  for (std::size_t k = 0; k < mass.size(); ++k)
    if (is_free(k))
      result[k] =
          mass[k] *
              ((1. - am) * now.acceleration[k] + am * step.acceleration[k] +
               parameters.mass_damping *
                   ((1. - af) * now.velocity[k] + af * step.velocity[k])) -
          (1. - af) * force(k) - af * step.force[k];
  return result;
}

void Membrane::State::correct(const MembraneStep &step,
                              const std::vector<Vector> &residual_now)
{
  const std::vector<Shares> shares = number_unknowns(now.is_tied, midpoints);
  const double end = 1. - step.rule.alpha_f, dt = step.time_step;
  const double inertia = ((1. - step.rule.alpha_m) / dt +
                          end * step.rule.gamma * parameters.mass_damping) /
                         (step.rule.beta * dt);
  std::vector<Eigen::Triplet<double>> entries;
  for (std::size_t k = 0; k < sheet.elements.size(); ++k)
    add_element(sheet.elements[k],
                end * element_tangent(sheet, k, now.position, now.pressure),
                shares, entries);
  int n = 0;
  for (std::size_t k = 0; k < mass.size(); ++k)
    for (int i = 0; i < 3 && is_free(k); ++i, ++n)
      entries.emplace_back(n, n, inertia * mass[k]);
  if (step.springs)
    for (std::size_t k = 0; k < mass.size(); ++k)
      for (int i = 0; i < 9 && is_free(k); ++i)
        entries.emplace_back(shares[k][0].first + i / 3,
                             shares[k][0].first + i % 3,
                             end * step.springs->stiffness[k](i / 3, i % 3));

  Matrix matrix(n, n);
  matrix.setFromTriplets(entries.begin(), entries.end());
  Eigen::VectorXd right(n);
  for (std::size_t k = 0; k < mass.size(); ++k)
    if (is_free(k))
      right.segment<3>(shares[k][0].first) = -residual_now[k];
  Eigen::SparseLU<Matrix> factors(matrix);
  if (factors.info() != Eigen::Success)
    throw std::runtime_error("membrane: the matrix of an implicit step cannot "
                             "be factored; a shorter step may help");
  const Eigen::VectorXd change = factors.solve(right);
  for (std::size_t k = 0; k < mass.size(); ++k)
    if (is_free(k))
      now.position[k] += change.segment<3>(shares[k][0].first);
  midpoints.spread(now.position);
  follow_positions(step);
}

void Membrane::State::follow_positions(const MembraneStep &step)
{
  const double dt = step.time_step;
  for (std::size_t k = 0; k < mass.size(); ++k)
  {
    if (!is_free(k))
      continue;
    now.acceleration[k] =
        (now.position[k] - step.predicted[k]) / (step.rule.beta * dt * dt);
    now.velocity[k] =
        step.velocity[k] + dt * ((1. - step.rule.gamma) * step.acceleration[k] +
                                 step.rule.gamma * now.acceleration[k]);
  }
  midpoints.spread(now.acceleration);
  midpoints.spread(now.velocity);
}

void Membrane::State::give_way(const MembraneStep &step)
{
  if (!step.springs)
    return;
  take_load(step.load);
  const auto &[stiffness, rest] = *step.springs;
  for (std::size_t k = 0; k < mass.size(); ++k)
    if (is_free(k))
      now.load[k] -= stiffness[k] * (now.position[k] - rest[k]);
}

std::vector<Vector> Membrane::State::residual_here(const MembraneStep &step)
{
  give_way(step);
  find_forces();
  return residual(step);
}

std::vector<Vector> Membrane::State::better_residual(
    const MembraneStep &step, const std::vector<Vector> &from, double size_from)
{
  std::vector<Vector> result = residual_here(step);
  for (int halvings = 0; sheet.material.has_wrinkles && halvings < 6 &&
                         !(size(result) < size_from);
       ++halvings)
  {
    for (std::size_t k = 0; k < mass.size(); ++k)
      now.position[k] = 0.5 * (from[k] + now.position[k]);
    follow_positions(step);
    result = residual_here(step);
  }
  return result;
}

/// Size of a residual that counts as none: of the forces, and of the positions
/// whose small changes the accelerations are [N].
double Membrane::State::round_off(const MembraneStep &step) const
{
  const double n_roots = std::sqrt(static_cast<double>(mass.size()));
  const double forces = n_roots * mean_element_force(sheet, now.position) +
                        size(now.load) +
                        std::abs(now.pressure) * size(now.forces.area);
  double squared = 0.;
  for (std::size_t k = 0; k < mass.size(); ++k)
    squared += mass[k] * mass[k] * now.position[k].squaredNorm();
  return 1e-10 * forces +
         1e-15 * std::sqrt(squared) /
             (step.rule.beta * step.time_step * step.time_step);
}

/// Half of the work with the forces and velocities before the step, half with
/// those after it.
void Membrane::State::book_step_from(const MembraneMotion &before)
{
  MembraneMotion after = before;
  std::swap(now, after);
  for (std::size_t k = 0; k < mass.size(); ++k)
  {
    now.moved[k] = after.position[k] - before.position[k];
    book_half_step(k);
  }
  after.moved = now.moved;
  after.done = now.done;
  std::swap(now, after);
  for (std::size_t k = 0; k < mass.size(); ++k)
    book_half_step(k);
}

void Membrane::advance(std::span<const Vector> load, double time_step,
                       const ImplicitRule &rule, const NodeSprings *springs)
{
  check_membrane_step(time_step);
  check_membrane_size("loads", load.size(), n_nodes());
  if (springs)
  {
    check_membrane_size("springs", springs->stiffness.size(), n_nodes());
    check_membrane_size("springs", springs->rest.size(), n_nodes());
  }
  MembraneMotion &now = state->now;
  const MembraneMotion before = now;
  if (!now.has_acceleration)
    state->start_accelerations();
  MembraneStep step{time_step,        rule, now.position, now.velocity,
                    now.acceleration, {},   now.position, load,
                    springs};
  for (std::size_t k = 0; k < n_nodes(); ++k)
  {
    step.force.push_back(state->force(k));
    const Vector drift = time_step * now.velocity[k];
    if (now.is_tied[k])
      now.position[k] += drift;
    step.predicted[k] +=
        drift + (0.5 - rule.beta) * time_step * time_step * now.acceleration[k];
    now.acceleration[k] = (now.position[k] - step.predicted[k]) /
                          (rule.beta * time_step * time_step);
    now.velocity[k] += time_step * ((1. - rule.gamma) * step.acceleration[k] +
                                    rule.gamma * now.acceleration[k]);
  }
  state->midpoints.spread(now.position);
  state->midpoints.spread(now.acceleration);
  state->midpoints.spread(now.velocity);
  state->take_load(load);
  std::vector<Vector> residual = state->residual_here(step);
  for (int round = 0; round <= 30; ++round)
  {
    if (size(residual) <= state->round_off(step))
    {
      state->book_step_from(before);
      return;
    }
    if (!std::isfinite(size(residual)))
      break;
    const std::vector<Vector> from = now.position;
    state->correct(step, residual);
    residual = state->better_residual(step, from, size(residual));
  }
  now = before;
  throw std::runtime_error("membrane: no equilibrium of an implicit step of " +
                           std::to_string(time_step) +
                           " s; a shorter step may help");
}
} // namespace fem
