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
  VectorXd stiffness_times(const VectorXd &q) const;
  VectorXd to_rows(std::span<const Eigen::Vector3d> load) const;
  void send_out(const VectorXd &q, std::vector<Eigen::Vector3d> &field) const;

  std::vector<InterfaceRow> rows;
  ReducedSystem system;
  double time_step = 0.;
  MatrixXd compliance; ///< of the interface at rest [m/N]
  MatrixXd inverse;    ///< of M + dt / 2 C + dt^2 / 4 K
  Eigen::LLT<MatrixXd> mass;
  std::vector<double> frequencies;

  VectorXd q, speed, acceleration;  ///< interface, then inner amplitudes
  VectorXd braking, braking_change; ///< C speed and C acceleration
  VectorXd load;                    ///< on the rows of the interface [N]
  std::vector<Eigen::Vector3d> displacement, velocity;
  double load_work = 0., lost = 0.;
};

/// K is condensed on the interface and diagonal on the inner modes.
VectorXd CondensedSolid::State::stiffness_times(const VectorXd &x) const
{
  const Index n = system.stiffness.rows(), m = x.size() - n;
  VectorXd result(x.size());
  result.head(n).noalias() = system.stiffness * x.head(n);
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
    MatrixXd matrix = s.system.mass;
    if (s.system.damping.size() > 0)
      matrix += 0.5 * dt * s.system.damping;
    matrix.topLeftCorner(n, n) += 0.25 * dt * dt * s.system.stiffness;
    matrix.diagonal().tail(size - n) +=
        0.25 * dt * dt * s.system.inner_stiffness;
    s.inverse = matrix.llt().solve(MatrixXd::Identity(size, size));
    s.mass.compute(s.system.mass);
  }
  s.q = s.speed = s.acceleration = VectorXd::Zero(size);
  s.braking = s.braking_change = s.q;
  s.load = VectorXd::Zero(n);
  s.displacement.assign(parameters.interface.size(), Eigen::Vector3d::Zero());
  s.velocity = s.displacement;
}
CondensedSolid::~CondensedSolid() = default;
CondensedSolid::CondensedSolid(CondensedSolid &&) noexcept = default;

void CondensedSolid::settle(std::span<const Eigen::Vector3d> load)
{
  State &s = *state;
  const VectorXd next = s.to_rows(load);
  s.lost += 0.5 * s.speed.dot(s.system.mass * s.speed);
  // Inner modes have no load: they stay where they are zero.
  const VectorXd before = s.q;
  const Index n = next.size();
  s.q.setZero();
  s.q.head(n).noalias() = s.compliance * next;
  const VectorXd moved = s.q - before;
  s.load_work += 0.5 * moved.head(n).dot(s.load + next);
  // What the inner modes held goes with them.
  s.lost += 0.5 * before.tail(s.q.size() - n)
                      .dot(s.system.inner_stiffness.cwiseProduct(
                          before.tail(s.q.size() - n)));
  s.load = next;
  s.speed.setZero();
  s.acceleration = s.braking = s.braking_change = s.speed;
  s.send_out(s.q, s.displacement);
  s.send_out(s.speed, s.velocity);
}

void CondensedSolid::set_load(std::span<const Eigen::Vector3d> load)
{
  State &s = *state;
  s.check_time_step();
  s.load = s.to_rows(load);
  VectorXd force = -s.stiffness_times(s.q) - s.braking;
  force.head(s.load.size()) += s.load;
  s.acceleration = s.mass.solve(force);
  if (s.system.damping.size() > 0)
    s.braking_change.noalias() = s.system.damping * s.acceleration;
}

void CondensedSolid::advance(std::span<const Eigen::Vector3d> load)
{
  State &s = *state;
  s.check_time_step();
  const double dt = s.time_step;
  const VectorXd next = s.to_rows(load);
  const Index n = next.size();
  const VectorXd start = s.q, speed = s.speed;
  s.q += dt * (s.speed + 0.25 * dt * s.acceleration);
  s.speed += 0.5 * dt * s.acceleration;
  VectorXd force = -s.stiffness_times(s.q);
  force.head(n) += next;
  const bool is_damped = s.system.damping.size() > 0;
  VectorXd braking = s.braking;
  if (is_damped)
  {
    braking += 0.5 * dt * s.braking_change; // C times the predicted speed
    force -= braking;
  }
  s.acceleration.noalias() = s.inverse * force;
  s.q += 0.25 * dt * dt * s.acceleration;
  s.speed += 0.5 * dt * s.acceleration;
  const VectorXd moved = s.q - start;
  if (is_damped)
  {
    s.braking_change.noalias() = s.system.damping * s.acceleration;
    braking += 0.5 * dt * s.braking_change;
    s.lost += 0.5 * moved.dot(s.braking + braking);
    s.braking = braking;
  }
  s.load_work += 0.5 * moved.head(n).dot(s.load + next);
  s.load = next;
  s.send_out(s.q, s.displacement);
  s.send_out(s.speed, s.velocity);
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
  const State &s = *state;
  SolidEnergy energy;
  energy.strain = 0.5 * s.q.dot(s.stiffness_times(s.q));
  energy.kinetic = 0.5 * s.speed.dot(s.system.mass * s.speed);
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
  const State &s = *state;
  for (const VectorXd *values : {&s.q, &s.speed, &s.acceleration, &s.braking,
                                 &s.braking_change, &s.load})
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
  for (VectorXd *values :
       {&s.q, &s.speed, &s.acceleration, &s.braking, &s.braking_change})
    read(*values, size);
  read(s.load, s.load.size());
  VectorXd sums;
  read(sums, 2);
  s.load_work = sums(0);
  s.lost = sums(1);
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
