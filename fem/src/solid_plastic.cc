#include "solid_state.h"

#include <cmath>
#include <stdexcept>

namespace fem
{
namespace
{
using Vector = Eigen::Vector3d;

constexpr int max_iterations = 40;
constexpr int max_halvings = 6;
constexpr double tolerance = 1e-11; // left over forces

double norm(std::span<const Vector> field)
{
  double sum = 0.;
  for (const Vector &v : field)
    sum += v.squaredNorm();
  return std::sqrt(sum);
}

/// start + share * step, hanging nodes with their parents.
NodeField moved(const SolidSupports &supports, const NodeField &start,
                double share, const NodeField &step)
{
  NodeField result = start;
  for (std::size_t k = 0; k < result.size(); ++k)
    result[k] += share * step[k];
  supports.spread(result);
  return result;
}

void check_finite(const Eigen::VectorXd &left)
{
  if (!left.allFinite())
    throw std::runtime_error("solid: cells turn inside out on the way to "
                             "equilibrium: the load is too much at once");
}
} // namespace

/// K u less the internal force, after this flow.
NodeField Solid::State::total_relief(std::span<const Vector> displacement,
                                     const PlasticState &flown) const
{
  NodeField force(mass.size(), Vector::Zero());
  plastic.relieve(flown, force);
  hyper.relieve(displacement, force);
  supports.collect(force);
  return force;
}

/// Internal force from K u at the last displacements.
void Solid::State::relieve(std::span<Vector> force) const
{
  if (is_linear())
    return;
  for (std::size_t k = 0; k < force.size(); ++k)
    force[k] -= now.relief[k];
}

/// How that relief grows on the way to these displacements.
NodeField Solid::State::relief(const NodeField &displacement) const
{
  PlasticState flown;
  plastic.respond(displacement, now.plastic, flown);
  NodeField force = total_relief(displacement, flown);
  for (std::size_t k = 0; k < force.size(); ++k)
    force[k] -= now.relief[k];
  return force;
}

/// What is out of balance: relief less what holds the correction up.
Eigen::VectorXd Solid::State::imbalance(const FlowSystem &system,
                                        const NodeField &correction) const
{
  const NodeField force =
      relief(moved(supports, *system.predicted, system.reach, correction));
  NodeField held(force.size());
  multiply(correction, held);
  for (std::size_t k = 0; k < force.size(); ++k)
    held[k] = system.share * force[k] - system.weights.stiffness * held[k] -
              system.weights.mass * mass[k] * correction[k] -
              system.weights.dashpot * dashpot[k] * correction[k];
  return to_unknowns(supports, held);
}

NodeField Solid::State::newton_step(const FlowSystem &system,
                                    const NodeField &correction,
                                    const Eigen::VectorXd &left) const
{
  const SparseMatrix elastic_part =
      assemble(parts(), system.weights).selfadjointView<Eigen::Lower>();
  const NodeField at =
      moved(supports, *system.predicted, system.reach, correction);
  std::vector<CellChange> changes;
  plastic.soften(at, now.plastic, changes);
  hyper.soften(at, changes);
  const SparseMatrix matrix =
      elastic_part +
      assemble_cells(parts(), changes, system.share * system.reach);
  NodeField step(mass.size(), Vector::Zero());
  from_unknowns(supports, solve_once(matrix, left), step);
  return step;
}

/// Newton's method, with steps that are halved until less is left over.
NodeField Solid::State::flow_correction(const FlowSystem &system)
{
  NodeField correction(mass.size(), Vector::Zero());
  Eigen::VectorXd left = imbalance(system, correction);
  NodeField linear(mass.size()); // what the relief is taken from
  multiply(*system.predicted, linear);
  const double scale = norm(now.elastic) + norm(linear) + left.norm();
  check_finite(left);
  newton_residuals.clear();
  if (left.norm() == 0.)
    return correction; // nothing flows
  newton_residuals.push_back(left.norm() / scale);
  while (newton_residuals.back() > tolerance)
  {
    if (newton_residuals.size() > max_iterations)
      throw std::runtime_error(
          "solid: no equilibrium in " + std::to_string(max_iterations) +
          " iterations: the load may be more than its layers bear");
    const NodeField step = newton_step(system, correction, left);
    const NodeField start = correction;
    double share = 1.;
    for (int k = 0; k <= max_halvings; ++k, share *= 0.5)
    {
      correction = moved(supports, start, share, step);
      left = imbalance(system, correction);
      if (left.norm() < newton_residuals.back() * scale)
        break;
    }
    check_finite(left);
    newton_residuals.push_back(left.norm() / scale);
  }
  return correction;
}
} // namespace fem
