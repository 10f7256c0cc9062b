#include <coupling/mean_cyclic_motion.h>
#include <dem/binary.h>
#include <dem/engine_boundaries.h>

namespace coupling
{
namespace
{
using dem::Quaternion;
using dem::Vec3;

/// More presses the particles harder than a load would; the springs' energy is
/// checked every so many steps.
constexpr double hardest = 4.;
constexpr int check_interval = 20;

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
    for (const std::int32_t particle : {pair.a, pair.b})
      is_touched[static_cast<std::size_t>(particle)] = 1;
  for (const dem::WallContact &wall : network.walls)
    is_touched[static_cast<std::size_t>(wall.particle)] = 1;
  return is_touched;
}

/// (x, y, z, 1) of a particle.
Eigen::Vector4d homogeneous_position(const dem::ParticleSystem &particles,
                                     std::size_t k)
{
  return particles.position(k).homogeneous();
}

/// u = F (x, 1) that fits the mean cyclic motion of the particles with contact
/// best.
Eigen::Matrix<double, 3, 4> affine_motion(const dem::ParticleSystem &particles,
                                          const std::vector<char> &is_touched,
                                          const MeanCyclicMotion &mean_motion)
{
  Eigen::Matrix4d square = Eigen::Matrix4d::Zero();
  Eigen::Matrix<double, 3, 4> right = Eigen::Matrix<double, 3, 4>::Zero();
  for (std::size_t k = 0; k < particles.size(); ++k)
  {
    if (!is_touched[k])
      continue;
    const Eigen::Vector4d at = homogeneous_position(particles, k);
    square += at * at.transpose();
    right += mean_motion.shift[static_cast<std::size_t>(particles.id[k])] *
             at.transpose();
  }
  return right * square.completeOrthogonalDecomposition().pseudoInverse();
}

/// No load is left on a particle with prescribed motion.
void extrapolate_particles(const MeanCyclicMotion &mean_motion, double rate,
                           dem::ParticleSystem &particles)
{
  for (std::size_t k = 0; k < particles.size(); ++k)
  {
    const auto id = static_cast<std::size_t>(particles.id[k]);
    particles.velocity(k) = rate * mean_motion.shift[id];
    particles.spin(k) = rate * mean_motion.turn[id];
    particles.load[k] = {};
  }
}

void set_walls(const MeanCyclicMotion &mean_motion, double rate,
               dem::Engine &engine)
{
  for (std::size_t k = 0; k < dem::planes(engine).size(); ++k)
    dem::planes(engine)[k].velocity = rate * mean_motion.planes[k];
  if (auto *side = dem::find_boundary<dem::DrumBoundary>(engine))
    side->drum.widening = rate * mean_motion.widening;
  if (engine.cell().is_there())
    engine.set_cell_rate(rate * mean_motion.cell);
}

void stop_all(const MeanCyclicMotion &mean_motion, dem::Engine &engine)
{
  set_walls(mean_motion, 0., engine);
  for (dem::ParticleState &particle : engine.particles().state)
    particle.velocity = particle.spin = Vec3::Zero();
}
} // namespace

Pose pose_of(const dem::Engine &engine, const TriaxialCell &cell)
{
  const dem::ParticleSystem &particles = engine.particles();
  Pose pose;
  pose.position.resize(particles.size());
  pose.orientation.resize(particles.size());
  for (std::size_t k = 0; k < particles.size(); ++k)
  {
    const auto id = static_cast<std::size_t>(particles.id[k]);
    pose.position[id] = particles.position(k);
    pose.orientation[id] = particles.orientation(k);
  }
  for (const dem::Plane &plane : dem::planes(engine))
    pose.planes.push_back(plane.point);
  const FieldView nodes = cell.motion().position;
  pose.nodes.assign(nodes.begin(), nodes.end());
  pose.radius = dem::drum(engine).radius;
  pose.cell = engine.cell().length;
  return pose;
}

MeanCyclicMotion mean_motion_between(const Pose &from, const Pose &to,
                                     double cycles)
{
  const double share = 1. / cycles;
  MeanCyclicMotion mean_motion;
  mean_motion.shift = difference(from.position, to.position, share);
  for (std::size_t k = 0; k < from.orientation.size(); ++k)
    mean_motion.turn.push_back(
        share *
        rotation_vector(to.orientation[k] * from.orientation[k].conjugate()));
  mean_motion.planes = difference(from.planes, to.planes, share);
  mean_motion.nodes = difference(from.nodes, to.nodes, share);
  mean_motion.widening = share * (to.radius - from.radius);
  mean_motion.cell = share * (to.cell - from.cell);
  return mean_motion;
}

void calm_rattlers(const dem::Engine &engine, MeanCyclicMotion &mean_motion)
{
  const dem::ParticleSystem &particles = engine.particles();
  const std::vector<char> is_touched = touched(engine);
  const auto affine = affine_motion(particles, is_touched, mean_motion);
  for (std::size_t k = 0; k < particles.size(); ++k)
  {
    if (is_touched[k])
      continue;
    const auto id = static_cast<std::size_t>(particles.id[k]);
    mean_motion.shift[id] = affine * homogeneous_position(particles, k);
    mean_motion.turn[id] = Vec3::Zero();
  }
}

double move_along(const MeanCyclicMotion &mean_motion, const Way &way,
                  Exchange &exchange, TriaxialCell &cell, dem::Engine &engine)
{
  const double in_step = way.cycles / way.n_steps,
               rate = in_step / way.time_step;
  std::vector<Vec3> shift = mean_motion.nodes, velocity = mean_motion.nodes;
  for (std::size_t k = 0; k < shift.size(); ++k)
  {
    shift[k] *= in_step;
    velocity[k] *= rate;
  }
  const CoupledParticles led{
      engine, [&engine](double step) { engine.advance(step); }, {}, {}};
  const double limit = hardest * engine.energy().elastic;
  set_walls(mean_motion, rate, engine);
  int step = 0;
  while (step < way.n_steps)
  {
    extrapolate_particles(mean_motion, rate, engine.particles());
    cell.displace(shift);
    exchange.follow(cell, velocity, led, way.time_step);
    if (++step % check_interval == 0 && engine.energy().elastic > limit)
      break;
  }
  stop_all(mean_motion, engine);
  return in_step * step;
}

void save(std::ostream &out, const Pose &pose)
{
  for (const auto *column : {&pose.position, &pose.planes, &pose.nodes})
    dem::write_column(out, *column);
  dem::write_column(out, pose.orientation);
  dem::write_value(out, pose.radius);
  dem::write_value(out, pose.cell);
}

void restore(std::istream &in, Pose &pose)
{
  for (auto *column : {&pose.position, &pose.planes, &pose.nodes})
    dem::read_column(in, *column);
  dem::read_column(in, pose.orientation);
  dem::read_value(in, pose.radius);
  dem::read_value(in, pose.cell);
}

void save(std::ostream &out, const MeanCyclicMotion &mean_motion)
{
  for (const auto *column : {&mean_motion.shift, &mean_motion.turn,
                             &mean_motion.planes, &mean_motion.nodes})
    dem::write_column(out, *column);
  dem::write_value(out, mean_motion.widening);
  dem::write_value(out, mean_motion.cell);
}

void restore(std::istream &in, MeanCyclicMotion &mean_motion)
{
  for (auto *column : {&mean_motion.shift, &mean_motion.turn,
                       &mean_motion.planes, &mean_motion.nodes})
    dem::read_column(in, *column);
  dem::read_value(in, mean_motion.widening);
  dem::read_value(in, mean_motion.cell);
}
} // namespace coupling
