#include "reduced_system.h"

#include <fem/condensed.h>

#include <Eigen/Cholesky>

#include <cmath>
#include <istream>
#include <ostream>
#include <stdexcept>

namespace fem
{
namespace
{
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

void check(const Solid &body, const SolidSupports &supports,
           const CondensedParameters &parameters, bool is_linear)
{
  if (!is_linear)
    throw std::invalid_argument("condensed solid: a layer of its body yields "
                                "or is neo-Hookean, all must be linear");
  if (parameters.interface.empty())
    throw std::invalid_argument("condensed solid: no nodes on its interface");
  for (const std::int32_t node : parameters.interface)
    if (node < 0 ||
        static_cast<std::size_t>(node) >= body.mesh().nodes.size() ||
        supports.is_hanging(static_cast<std::size_t>(node)))
      throw std::invalid_argument(
          "condensed solid: interface node = " + std::to_string(node) +
          ", must exist and not hang");
  if (parameters.n_inner_modes < 0 || !(parameters.time_step >= 0.))
    throw std::invalid_argument("condensed solid: n_inner_modes and time_step "
                                "must not be negative");
}
} // namespace

struct CondensedSolid::State
{
  void check_time_step() const
  {
    if (!(time_step > 0.))
      throw std::logic_error("condensed solid: built without a time step");
  }
  VectorXd stiffness_times(const VectorXd &x) const;
  VectorXd to_rows(std::span<const Eigen::Vector3d> field) const;
  void send_out(const VectorXd &x, std::vector<Eigen::Vector3d> &field) const;
  void step(const VectorXd &next);
  void close_step();

  std::vector<InterfaceRow> rows;
  ReducedSystem system;
  double time_step = 0.;
  MatrixXd compliance; ///< of the interface at rest [m/N]
  MatrixXd inverse;    ///< of 2 / dt M + C + dt / 2 K
  std::vector<double> frequencies;

  VectorXd q, speed;          ///< interface, then inner amplitudes
  VectorXd elastic, momentum; ///< K q and M speed
  VectorXd load;              ///< on the rows of the interface [N]
  /// Of the last step, while `elastic` and `momentum` are of its start.
  bool is_open = false;
  VectorXd mean_speed, mean_load;
  std::vector<Eigen::Vector3d> displacement, velocity;
  double load_work = 0., lost = 0.;
};

/// K is condensed on the interface and diagonal on the inner modes.
VectorXd CondensedSolid::State::stiffness_times(const VectorXd &x) const
{
  const Index n = system.stiffness.rows(), m = x.size() - n;
  VectorXd result(x.size());
  result.head(n).noalias() =
      system.stiffness.selfadjointView<Eigen::Lower>() * x.head(n);
  result.tail(m) = system.inner_stiffness.cwiseProduct(x.tail(m));
  return result;
}

VectorXd
CondensedSolid::State::to_rows(std::span<const Eigen::Vector3d> field) const
{
  if (field.size() != displacement.size())
    throw std::invalid_argument(
        "condensed solid: " + std::to_string(field.size()) + " loads for " +
        std::to_string(displacement.size()) + " nodes of its interface");
  VectorXd result(static_cast<Index>(rows.size()));
  for (std::size_t k = 0; k < rows.size(); ++k)
    result(static_cast<Index>(k)) = field[rows[k].node](rows[k].component);
  return result;
}

void CondensedSolid::State::send_out(const VectorXd &x,
                                     std::vector<Eigen::Vector3d> &field) const
{
  for (std::size_t k = 0; k < rows.size(); ++k)
    field[rows[k].node](rows[k].component) = x(static_cast<Index>(k));
}

CondensedSolid::CondensedSolid(const Solid &body,
                               const CondensedParameters &parameters)
    : state(std::make_unique<State>())
{
  const Solid::State &full = *body.state;
  check(body, full.supports, parameters, full.is_linear());
  State &s = *state;
  s.rows = interface_rows(full.supports, parameters.interface);
  s.system = reduce(full.parts(), full.parameters.stiffness_damping, s.rows,
                    parameters.n_inner_modes);
  for (const double squared : s.system.inner_stiffness)
    s.frequencies.push_back(std::sqrt(squared));
  const Index n = s.system.stiffness.rows(), size = s.system.size();
  s.compliance = s.system.stiffness.llt().solve(MatrixXd::Identity(n, n));

  const double dt = s.time_step = parameters.time_step;
  if (dt > 0.)
  {
    MatrixXd matrix = 2. / dt * s.system.mass;
    if (s.system.damping.size() > 0)
      matrix += s.system.damping;
    matrix.topLeftCorner(n, n) += 0.5 * dt * s.system.stiffness;
    matrix.diagonal().tail(size - n) += 0.5 * dt * s.system.inner_stiffness;
    s.inverse = matrix.llt().solve(MatrixXd::Identity(size, size));
  }
  s.q = s.speed = s.elastic = s.momentum = VectorXd::Zero(size);
  s.load = VectorXd::Zero(n);
  s.displacement.assign(parameters.interface.size(), Eigen::Vector3d::Zero());
  s.velocity = s.displacement;
}
CondensedSolid::~CondensedSolid() = default;
CondensedSolid::CondensedSolid(CondensedSolid &&) noexcept = default;

void CondensedSolid::settle(std::span<const Eigen::Vector3d> load)
{
  State &s = *state;
  s.close_step();
  const VectorXd next = s.to_rows(load);
  const Index n = next.size(), m = s.q.size() - n;
  // Inner modes have no load: they stay where they are zero; what they held
  // goes with them.
  s.lost +=
      0.5 * s.speed.dot(s.momentum) + 0.5 * s.q.tail(m).dot(s.elastic.tail(m));
  const VectorXd before = s.q.head(n);
  s.q.setZero();
  s.q.head(n).noalias() = s.compliance * next;
  s.load_work += 0.5 * (s.q.head(n) - before).dot(s.load + next);
  s.load = next;
  s.elastic.setZero();
  s.elastic.head(n) = next;
  s.speed.setZero();
  s.momentum.setZero();
  s.send_out(s.q, s.displacement);
  s.send_out(s.speed, s.velocity);
}

void CondensedSolid::set_load(std::span<const Eigen::Vector3d> load)
{
  state->check_time_step();
  state->load = state->to_rows(load);
}

void CondensedSolid::advance(std::span<const Eigen::Vector3d> load)
{
  State &s = *state;
  s.check_time_step();
  s.close_step();
  s.step(s.to_rows(load));
  s.send_out(s.q, s.displacement);
  s.send_out(s.speed, s.velocity);
}

/// Average acceleration, which is the trapezoidal rule: for the mean speed v,
/// (2 / dt M + C + dt / 2 K) v = 2 / dt M speed - K q + mean load.
void CondensedSolid::State::step(const VectorXd &next)
{
  const Index n = next.size();
  mean_load = 0.5 * (load + next);
  VectorXd force = 2. / time_step * momentum - elastic;
  force.head(n) += mean_load;
  mean_speed.noalias() = inverse.selfadjointView<Eigen::Lower>() * force;
  q += time_step * mean_speed;
  speed = 2. * mean_speed - speed;
  load_work += time_step * mean_speed.head(n).dot(mean_load);
  load = next;
  is_open = true;
}

/// Products for the next step and for energies; a step that is taken back
/// never needs them.
void CondensedSolid::State::close_step()
{
  if (!is_open)
    return;
  const VectorXd stiffening = stiffness_times(mean_speed);
  VectorXd force = -elastic - 0.5 * time_step * stiffening;
  force.head(mean_load.size()) += mean_load;
  if (system.damping.size() > 0)
  {
    VectorXd braking(q.size());
    braking.noalias() =
        system.damping.selfadjointView<Eigen::Lower>() * mean_speed;
    force -= braking;
    lost += time_step * mean_speed.dot(braking);
  }
  momentum += time_step * force;
  elastic += time_step * stiffening;
  is_open = false;
}

std::span<const Eigen::Vector3d> CondensedSolid::displacements() const
{
  return state->displacement;
}
std::span<const Eigen::Vector3d> CondensedSolid::velocities() const
{
  return state->velocity;
}

SolidEnergy CondensedSolid::energy() const
{
  State &s = *state;
  s.close_step();
  SolidEnergy energy;
  energy.strain = 0.5 * s.q.dot(s.elastic);
  energy.kinetic = 0.5 * s.speed.dot(s.momentum);
  energy.damping = s.lost;
  energy.load_work = s.load_work;
  return energy;
}

void CondensedSolid::save(std::ostream &out) const
{
  const auto write = [&out](const VectorXd &values)
  {
    const Index n = values.size();
    out.write(reinterpret_cast<const char *>(&n), sizeof(n));
    out.write(reinterpret_cast<const char *>(values.data()),
              static_cast<std::streamsize>(sizeof(double)) * n);
  };
  State &s = *state;
  s.close_step();
  for (const VectorXd *values :
       {&s.q, &s.speed, &s.elastic, &s.momentum, &s.load})
    write(*values);
  write(Eigen::Vector2d(s.load_work, s.lost));
}

void CondensedSolid::load(std::istream &in)
{
  const auto read = [&in](VectorXd &values, Index expected)
  {
    Index n = -1;
    in.read(reinterpret_cast<char *>(&n), sizeof(n));
    if (!in || n != expected)
      throw std::runtime_error("condensed solid: the checkpoint ends early or "
                               "belongs to another body");
    values.resize(n);
    if (!in.read(reinterpret_cast<char *>(values.data()),
                 static_cast<std::streamsize>(sizeof(double)) * n))
      throw std::runtime_error("condensed solid: the checkpoint ends early");
  };
  State &s = *state;
  const Index size = s.q.size();
  for (VectorXd *values : {&s.q, &s.speed, &s.elastic, &s.momentum})
    read(*values, size);
  read(s.load, s.load.size());
  VectorXd sums;
  read(sums, 2);
  s.load_work = sums(0);
  s.lost = sums(1);
  s.is_open = false;
  s.send_out(s.q, s.displacement);
  s.send_out(s.speed, s.velocity);
}

std::size_t CondensedSolid::n_unknowns() const
{
  return static_cast<std::size_t>(state->q.size());
}
std::span<const double> CondensedSolid::inner_frequencies() const
{
  return state->frequencies;
}
} // namespace fem
