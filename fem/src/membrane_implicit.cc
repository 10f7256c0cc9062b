#include "membrane_state.h"

#include <Eigen/Sparse>
#include <Eigen/SparseLU>

#include <array>
#include <cmath>
#include <sstream>
#include <stdexcept>

namespace fem
{
namespace
{
using Vector = Eigen::Vector3d;
using Matrix = Eigen::SparseMatrix<double>;

/// Unknowns of a node along x, y, z; below 0: tied.
using Unknowns = std::array<int, 3>;

/// What moves a node of an element: the unknowns of a node, and its weight.
using Shares = std::vector<std::pair<Unknowns, double>>;

/// Unknowns of the nodes and how many there are.
struct Numbering
{
  std::vector<Shares> shares; ///< own, those of the ends of the edge, or none
  int n = 0;

  /// Of a node that moves by itself.
  const Unknowns &of(std::size_t k) const { return shares[k].front().first; }
};

Numbering number_unknowns(std::span<const std::uint8_t> tied,
                          const Followers &midpoints)
{
  Numbering numbers{std::vector<Shares>(tied.size()), 0};
  for (std::size_t k = 0; k < tied.size(); ++k)
  {
    if (tied[k] == all_axes || midpoints.is_hanging(k))
      continue;
    Unknowns own{-1, -1, -1};
    for (int c = 0; c < 3; ++c)
      if (!is_tied_along(tied[k], c))
        own[static_cast<std::size_t>(c)] = numbers.n++;
    numbers.shares[k] = {{own, 1.}};
  }
  for (std::size_t k = 0; k < tied.size(); ++k)
    if (midpoints.is_hanging(k))
      for (const auto &[end, weight] : midpoints.parents(k))
        if (const Shares &own = numbers.shares[static_cast<std::size_t>(end)];
            !own.empty())
          numbers.shares[k].emplace_back(own.front().first, weight);
  return numbers;
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
        {
          const int at_row = r[static_cast<std::size_t>(row % 3)],
                    at_column = c[static_cast<std::size_t>(column % 3)];
          if (at_row >= 0 && at_column >= 0)
            entries.emplace_back(at_row, at_column,
                                 of_r * of_c * tangent(row, column));
        }
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
        is_free(k)
            ? free_along(k, force(k) / mass[k] -
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
      result[k] = free_along(
          k, mass[k] * ((1. - am) * now.acceleration[k] +
                        am * step.acceleration[k] +
                        parameters.mass_damping * ((1. - af) * now.velocity[k] +
                                                   af * step.velocity[k])) -
                 (1. - af) * force(k) - af * step.force[k]);
  return result;
}

void Membrane::State::correct(const MembraneStep &step,
                              const std::vector<Vector> &residual_now)
{
  const Numbering numbers = number_unknowns(now.tied, midpoints);
  /// Calls call(node, component, unknown) for all unknowns.
  const auto for_unknowns = [&](const auto &call)
  {
    for (std::size_t k = 0; k < mass.size(); ++k)
      for (int c = 0; is_free(k) && c < 3; ++c)
        if (const int u = numbers.of(k)[static_cast<std::size_t>(c)]; u >= 0)
          call(k, c, u);
  };
  const double end = 1. - step.rule.alpha_f, dt = step.time_step;
  const double inertia = ((1. - step.rule.alpha_m) / dt +
                          end * step.rule.gamma * parameters.mass_damping) /
                         (step.rule.beta * dt);
  std::vector<Eigen::Triplet<double>> entries;
  for (std::size_t k = 0; k < sheet.elements.size(); ++k)
    add_element(sheet.elements[k],
                end * element_tangent(sheet, k, now.position, now.pressure),
                numbers.shares, entries);
  for_unknowns([&](std::size_t k, int, int u)
               { entries.emplace_back(u, u, inertia * mass[k]); });
  if (step.springs)
    for_unknowns(
        [&](std::size_t k, int row, int u)
        {
          for (int column = 0; column < 3; ++column)
            if (const int v = numbers.of(k)[static_cast<std::size_t>(column)];
                v >= 0)
              entries.emplace_back(
                  u, v, end * step.springs->stiffness[k](row, column));
        });

  Matrix matrix(numbers.n, numbers.n);
  matrix.setFromTriplets(entries.begin(), entries.end());
  Eigen::VectorXd right(numbers.n);
  for_unknowns([&](std::size_t k, int c, int u)
               { right[u] = -residual_now[k][c]; });
  Eigen::SparseLU<Matrix> factors(matrix);
  if (factors.info() != Eigen::Success)
    throw std::runtime_error("membrane: the matrix of an implicit step is "
                             "singular: " +
                             why_no_equilibrium(residual_now, round_off(step)));
  const Eigen::VectorXd change = factors.solve(right);
  for_unknowns([&](std::size_t k, int c, int u)
               { now.position[k][c] += change[u]; });
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
  // A stiff spring turns the last digit of a position into a force.
  double of_springs = 0.;
  for (std::size_t k = 0; step.springs && k < mass.size(); ++k)
    if (is_free(k))
      of_springs +=
          step.springs->stiffness[k].squaredNorm() *
          (now.position[k].squaredNorm() + step.springs->rest[k].squaredNorm());
  return 1e-10 * forces + 1e-15 * std::sqrt(of_springs) +
         1e-15 * std::sqrt(squared) /
             (step.rule.beta * step.time_step * step.time_step);
}

std::string
Membrane::State::why_no_equilibrium(const std::vector<Vector> &residual,
                                    double asked) const
{
  std::size_t worst = 0;
  for (std::size_t k = 0; k < residual.size(); ++k)
  {
    if (!residual[k].allFinite())
      return "positions are no longer finite; a load or a spring is beyond "
             "what the sheet can balance";
    if (residual[k].squaredNorm() > residual[worst].squaredNorm())
      worst = k;
  }
  const Vector &at = now.position[worst];
  const double wrinkled = sheet.material.has_wrinkles
                              ? 0.
                              : fem::wrinkled_share(sheet, now.position);
  std::ostringstream text;
  text << "node " << worst << " at (" << at.x() << ", " << at.y() << ", "
       << at.z() << ") m is left with " << residual[worst].norm()
       << " N, where all nodes together may be left with " << asked << " N; ";
  if (wrinkled > 0.)
    text << std::lround(std::ceil(100. * wrinkled))
         << " % of the sheet is in compression, where it buckles without "
            "bending stiffness: give it a tension or wrinkling = tension_field";
  else
    text << "a shorter step may help";
  return text.str();
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
    if (now.tied[k] != 0)
      now.position[k] += state->tied_along(k, drift);
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
  const std::string why =
      state->why_no_equilibrium(residual, state->round_off(step));
  now = before;
  throw std::runtime_error("membrane: no equilibrium of an implicit step of " +
                           std::to_string(time_step) + " s: " + why);
}
} // namespace fem
