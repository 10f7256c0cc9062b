#include "triaxial/drift.h"

#include <dem/io/binary.h>

namespace spall
{
namespace
{
using dem::Quaternion;
using dem::Vec3;

/// More presses the stones harder than a load would; the springs' energy is
/// looked at every so many steps.
constexpr double hardest = 4.;
constexpr int look_interval = 20;

/// Of the smaller angle.
Vec3 rotation_vector(const Quaternion &turn)
{
  const Eigen::AngleAxisd angle(turn.w() < 0. ? Quaternion(-turn.coeffs())
                                              : turn);
  return angle.angle() * angle.axis();
}

std::vector<Vec3> difference(const std::vector<Vec3> &from,
                             const std::vector<Vec3> &to, double factor)
{
  std::vector<Vec3> change(from.size());
  for (std::size_t k = 0; k < from.size(); ++k)
    change[k] = factor * (to[k] - from[k]);
  return change;
}

std::vector<char> touched(const dem::Engine &engine)
{
  std::vector<char> is_touched(engine.particles().size(), 0);
  const dem::Network network = dem::contact_network_of(engine);
  for (const dem::PairContact &pair : network.pairs)
    for (const std::int32_t stone : {pair.a, pair.b})
      is_touched[static_cast<std::size_t>(stone)] = 1;
  for (const dem::WallContact &wall : network.walls)
    is_touched[static_cast<std::size_t>(wall.stone)] = 1;
  return is_touched;
}

/// (x, y, z, 1) of a stone.
Eigen::Vector4d place_of(const dem::Particles &stones, std::size_t k)
{
  return stones.position(k).homogeneous();
}

/// u = F (x, 1) that fits the drift of the stones with contact best.
Eigen::Matrix<double, 3, 4> affine_drift(const dem::Particles &stones,
                                         const std::vector<char> &is_touched,
                                         const Drift &drift)
{
  Eigen::Matrix4d square = Eigen::Matrix4d::Zero();
  Eigen::Matrix<double, 3, 4> right = Eigen::Matrix<double, 3, 4>::Zero();
  for (std::size_t k = 0; k < stones.size(); ++k)
  {
    if (!is_touched[k])
      continue;
    const Eigen::Vector4d at = place_of(stones, k);
    square += at * at.transpose();
    right +=
        drift.shift[static_cast<std::size_t>(stones.id[k])] * at.transpose();
  }
  return right * square.completeOrthogonalDecomposition().pseudoInverse();
}

/// No load is left to kick a stone that is led.
void lead_stones(const Drift &drift, double rate, dem::Particles &stones)
{
  for (std::size_t k = 0; k < stones.size(); ++k)
  {
    const auto id = static_cast<std::size_t>(stones.id[k]);
    stones.velocity(k) = rate * drift.shift[id];
    stones.spin(k) = rate * drift.turn[id];
    stones.load[k] = {};
  }
}

void set_planes(const Drift &drift, double rate, dem::Engine &engine)
{
  for (std::size_t k = 0; k < engine.planes().size(); ++k)
    engine.planes()[k].velocity = rate * drift.planes[k];
  engine.drum().widening = rate * drift.widening;
}

void stop_all(const Drift &drift, dem::Engine &engine)
{
  set_planes(drift, 0., engine);
  for (dem::StoneState &stone : engine.particles().state)
    stone.velocity = stone.spin = Vec3::Zero();
}
} // namespace

Pose pose_of(const dem::Engine &engine, const coupling::CellBody &cell)
{
  const dem::Particles &stones = engine.particles();
  Pose pose;
  pose.position.resize(stones.size());
  pose.orientation.resize(stones.size());
  for (std::size_t k = 0; k < stones.size(); ++k)
  {
    const auto id = static_cast<std::size_t>(stones.id[k]);
    pose.position[id] = stones.position(k);
    pose.orientation[id] = stones.orientation(k);
  }
  for (const dem::Plane &plane : engine.planes())
    pose.planes.push_back(plane.point);
  const coupling::FieldView nodes = cell.motion().position;
  pose.nodes.assign(nodes.begin(), nodes.end());
  pose.radius = engine.drum().radius;
  return pose;
}

Drift drift_between(const Pose &from, const Pose &to, double cycles)
{
  const double share = 1. / cycles;
  Drift drift;
  drift.shift = difference(from.position, to.position, share);
  for (std::size_t k = 0; k < from.orientation.size(); ++k)
    drift.turn.push_back(
        share *
        rotation_vector(to.orientation[k] * from.orientation[k].conjugate()));
  drift.planes = difference(from.planes, to.planes, share);
  drift.nodes = difference(from.nodes, to.nodes, share);
  drift.widening = share * (to.radius - from.radius);
  return drift;
}

void calm_rattlers(const dem::Engine &engine, Drift &drift)
{
  const dem::Particles &stones = engine.particles();
  const std::vector<char> is_touched = touched(engine);
  const auto affine = affine_drift(stones, is_touched, drift);
  for (std::size_t k = 0; k < stones.size(); ++k)
  {
    if (is_touched[k])
      continue;
    const auto id = static_cast<std::size_t>(stones.id[k]);
    drift.shift[id] = affine * place_of(stones, k);
    drift.turn[id] = Vec3::Zero();
  }
}

double move_along(const Drift &drift, const Way &way,
                  coupling::Exchange &exchange, coupling::CellBody &cell,
                  dem::Engine &engine)
{
  const double in_step = way.cycles / way.n_steps,
               rate = in_step / way.time_step;
  std::vector<Vec3> shift = drift.nodes, velocity = drift.nodes;
  for (std::size_t k = 0; k < shift.size(); ++k)
  {
    shift[k] *= in_step;
    velocity[k] *= rate;
  }
  const coupling::Stones led{
      engine, [&engine](double step) { engine.advance(step); }, {}, {}};
  const double limit = hardest * engine.energy().elastic;
  set_planes(drift, rate, engine);
  int step = 0;
  while (step < way.n_steps)
  {
    lead_stones(drift, rate, engine.particles());
    cell.displace(shift);
    exchange.follow(cell, velocity, led, way.time_step);
    if (++step % look_interval == 0 && engine.energy().elastic > limit)
      break;
  }
  stop_all(drift, engine);
  return in_step * step;
}

void save(std::ostream &out, const Pose &pose)
{
  for (const auto *column : {&pose.position, &pose.planes, &pose.nodes})
    dem::write_column(out, *column);
  dem::write_column(out, pose.orientation);
  dem::write_value(out, pose.radius);
}

void restore(std::istream &in, Pose &pose)
{
  for (auto *column : {&pose.position, &pose.planes, &pose.nodes})
    dem::read_column(in, *column);
  dem::read_column(in, pose.orientation);
  dem::read_value(in, pose.radius);
}

void save(std::ostream &out, const Drift &drift)
{
  for (const auto *column :
       {&drift.shift, &drift.turn, &drift.planes, &drift.nodes})
    dem::write_column(out, *column);
  dem::write_value(out, drift.widening);
}

void restore(std::istream &in, Drift &drift)
{
  for (auto *column : {&drift.shift, &drift.turn, &drift.planes, &drift.nodes})
    dem::read_column(in, *column);
  dem::read_value(in, drift.widening);
}
} // namespace spall
