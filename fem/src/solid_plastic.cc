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
} // namespace

void Solid::State::relieve(std::span<Vector> force) const
{
  if (plastic.empty())
    return;
  NodeField less(mass.size(), Vector::Zero());
  plastic.relieve(now.plastic, less);
  supports.collect(less);
  for (std::size_t k = 0; k < less.size(); ++k)
    force[k] += less[k];
}

/// Force that plastic flow on the way to these displacements leaves over.
NodeField Solid::State::relief(const NodeField &displacement) const
{
  PlasticState flown;
  plastic.respond(displacement, now.plastic, flown);
  for (std::size_t k = 0; k < flown.strain.size(); ++k)
    flown.strain[k] = now.plastic.strain[k] - flown.strain[k];
  NodeField force(mass.size(), Vector::Zero());
  plastic.relieve(flown, force);
  supports.collect(force);
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
  const SparseMatrix matrix =
      elastic_part +
      assemble_cells(parts(),
                     plastic.softening(moved(supports, *system.predicted,
                                             system.reach, correction),
                                       now.plastic),
                     system.share * system.reach);
  NodeField step(mass.size(), Vector::Zero());
  from_unknowns(supports, solve_once(matrix, left), step);
  return step;
}

/// Newton's method, with steps that are halved until less is left over.
NodeField Solid::State::flow_correction(const FlowSystem &system)
{
  NodeField correction(mass.size(), Vector::Zero());
  Eigen::VectorXd left = imbalance(system, correction);
  const double scale = norm(now.elastic) + left.norm();
  newton_residuals.clear();
  if (left.norm() == 0.)
    return correction; // nothing flows
  newton_residuals.push_back(left.norm() / scale);
  while (newton_residuals.back() > tolerance)
  {
    if (newton_residuals.size() > max_iterations)
      throw std::runtime_error(
          "solid: its layers that yield find no equilibrium in " +
          std::to_string(max_iterations) +
          " iterations: the load may be more than they bear");
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
    newton_residuals.push_back(left.norm() / scale);
  }
  return correction;
}
} // namespace fem
