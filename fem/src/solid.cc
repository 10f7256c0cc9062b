#include "face_points.h"
#include "solid_state.h"
#include "stable_step.h"

#include <fem/solid_surface.h>

#include <cmath>
#include <stdexcept>

namespace fem
{
namespace
{
using Vector = Eigen::Vector3d;
using Matrix = Eigen::Matrix3d;

const SolidMesh &checked(const SolidParameters &parameters,
                         const SolidMesh &mesh)
{
  check_solid(parameters, mesh);
  return mesh;
}

std::size_t checked_node(const SolidMesh &mesh, std::int32_t node)
{
  if (node < 0 || static_cast<std::size_t>(node) >= mesh.nodes.size())
    throw std::invalid_argument("solid: node = " + std::to_string(node) +
                                ", must be below " +
                                std::to_string(mesh.nodes.size()));
  return static_cast<std::size_t>(node);
}
} // namespace

namespace
{
/// Springs per area of hold_far_field, along x, y, z [N/m^3].
Vector far_springs(const SolidLayer &layer, const FacePoint &point,
                   const Vector &origin)
{
  const Vector away = point.position - origin;
  const double distance = away.norm();
  const double facing = away.dot(point.area.normalized());
  if (!(facing > 0.))
    throw std::invalid_argument(
        "solid: a far boundary must face away from the load");
  const double nu = layer.poisson_ratio;
  const double shear = layer.youngs_modulus / (2. * (1. + nu));
  const double down = -away.z() / distance;
  const double scale = shear * facing / (distance * distance);
  const double vertical =
      6. * scale * down * down / (2. * (1. - nu) + down * down);
  return {0.5 * scale, 0.5 * scale, vertical};
}
} // namespace

double pressure_wave_speed(const SolidLayer &layer)
{
  const double nu = layer.poisson_ratio;
  return std::sqrt(layer.youngs_modulus * (1. - nu) /
                   ((1. + nu) * (1. - 2. * nu) * layer.density));
}

double shear_wave_speed(const SolidLayer &layer)
{
  return std::sqrt(layer.youngs_modulus /
                   (2. * (1. + layer.poisson_ratio) * layer.density));
}

Solid::State::State(const SolidParameters &p, const SolidMesh &m)
    : parameters(p), mesh(checked(p, m)), elastic(mesh, parameters.layers),
      hyper(mesh, parameters.layers), plastic(mesh, parameters.layers),
      supports(mesh), mass(elastic.mass().begin(), elastic.mass().end()),
      absorber(mesh.nodes.size(), Matrix::Zero()),
      has_absorber(mesh.nodes.size(), 0)
{
  supports.collect(mass);
  const NodeField zeros(mesh.nodes.size(), Vector::Zero());
  now.displacement = now.velocity = now.acceleration = now.moved = zeros;
  now.load = now.elastic = now.viscous = zeros;
  now.support_velocity = now.support_displacement = zeros;
  now.plastic = plastic.start();
  now.relief = zeros;
  update_dashpots();
}

void Solid::State::update_dashpots()
{
  dashpot = absorber;
  for (std::size_t k = 0; k < dashpot.size(); ++k)
  {
    dashpot[k] += parameters.mass_damping * mass[k] * Matrix::Identity();
    for (int c = 0; c < 3; ++c)
      if (supports.is_fixed(k, c))
      {
        dashpot[k].row(c).setZero();
        dashpot[k].col(c).setZero();
      }
  }
  ++n_dashpot_changes;
  identity.reset();
}

/// Whoever sets the velocity of a support does the work that its mass takes.
void Solid::State::put_supports_in_motion()
{
  for (std::size_t k = 0; k < mass.size(); ++k)
    for (int c = 0; c < 3; ++c)
    {
      if (!supports.is_fixed(k, c))
        continue;
      const double given = now.support_velocity[k](c);
      double &speed = now.velocity[k](c);
      now.done.support_work += 0.5 * mass[k] * (given * given - speed * speed);
      speed = given;
    }
}

void Solid::State::set_load(std::span<const Vector> load)
{
  check_solid_loads(load.size(), mass.size());
  std::copy(load.begin(), load.end(), now.load.begin());
  supports.collect(now.load);
}

void Solid::State::multiply(std::span<const Vector> u,
                            std::span<Vector> out) const
{
  elastic.multiply(u, out);
  supports.collect(out);
  for (std::size_t k = 0; k < bedding.size(); ++k)
    out[k] += bedding[k] * u[k];
}

void Solid::State::update_forces()
{
  multiply(now.displacement, now.elastic);
  if (!is_linear())
  {
    PlasticState flown;
    plastic.respond(now.displacement, now.plastic, flown);
    now.done.plastic += plastic.dissipated(now.plastic, flown);
    now.plastic = std::move(flown);
    now.relief = total_relief(now.displacement, now.plastic);
    relieve(now.elastic);
  }
  if (parameters.stiffness_damping == 0.)
    return;
  multiply(now.velocity, now.viscous);
  for (Vector &force : now.viscous)
    force *= parameters.stiffness_damping;
}

void Solid::State::book_half_step()
{
  for (std::size_t k = 0; k < mass.size(); ++k)
  {
    if (supports.is_hanging(k))
      continue;
    const Vector half = 0.5 * now.moved[k];
    const double braked = half.dot(dashpot[k] * now.velocity[k]);
    double damped = 0.;
    for (int c = 0; c < 3; ++c)
      if (supports.is_fixed(k, c))
        now.done.support_work -= half(c) * force(k)(c);
      else
        damped +=
            parameters.mass_damping * mass[k] * half(c) * now.velocity[k](c);
    now.done.load_work += half.dot(now.load[k]);
    now.done.absorbed += braked - damped;
    now.done.damping += damped + half.dot(now.viscous[k]);
  }
}

double Solid::State::strain_energy() const
{
  double sum = plastic.stored_beyond(now.plastic) +
               hyper.stored_beyond(now.displacement);
  for (std::size_t k = 0; k < mass.size(); ++k)
    sum += 0.5 * now.displacement[k].dot(now.elastic[k]);
  return sum;
}

Solid::Solid(const SolidParameters &parameters, const SolidMesh &mesh)
    : state(std::make_unique<State>(parameters, mesh))
{
}
Solid::~Solid() = default;
Solid::Solid(Solid &&) noexcept = default;

void Solid::fix(std::int32_t boundary, const std::array<bool, 3> &components)
{
  state->supports.fix(boundary_nodes(state->mesh, boundary), components);
  state->update_dashpots();
  state->put_supports_in_motion();
}

void Solid::fix_node(std::int32_t node, const std::array<bool, 3> &components)
{
  checked_node(state->mesh, node);
  state->supports.fix({&node, 1}, components);
  state->update_dashpots();
  state->put_supports_in_motion();
}

void Solid::set_support_velocity(std::int32_t node, const Vector &velocity)
{
  state->now.support_velocity[checked_node(state->mesh, node)] = velocity;
}

void Solid::set_support_displacement(std::int32_t node,
                                     const Vector &displacement)
{
  state->now.support_displacement[checked_node(state->mesh, node)] =
      displacement;
}

void Solid::absorb(std::int32_t boundary)
{
  boundary_nodes(state->mesh, boundary); // there is one
  for (const SolidMesh::Face &face : state->mesh.faces)
  {
    if (face.boundary != boundary)
      continue;
    const auto cell = static_cast<std::size_t>(face.cell);
    const SolidLayer &layer =
        state->parameters
            .layers[static_cast<std::size_t>(state->mesh.layer[cell])];
    const double along = layer.density * pressure_wave_speed(layer);
    const double across = layer.density * shear_wave_speed(layer);
    for (const FacePoint &point : face_points(state->mesh, face, 1))
    {
      const Vector normal = point.area.normalized();
      const Matrix per_area = across * Matrix::Identity() +
                              (along - across) * normal * normal.transpose();
      for (std::size_t v = 0; v < 4; ++v)
      {
        const auto node = static_cast<std::size_t>(face.corners[v]);
        state->absorber[node] += point.value[v] * point.area.norm() * per_area;
        state->has_absorber[node] = 1;
      }
    }
  }
  state->supports.collect(state->absorber, state->has_absorber);
  state->update_dashpots();
}

void Solid::hold_far_field(std::int32_t boundary, const Vector &origin)
{
  boundary_nodes(state->mesh, boundary); // there is one
  std::vector<Matrix> springs(state->mesh.nodes.size(), Matrix::Zero());
  std::vector<char> is_there(springs.size(), 0);
  for (const SolidMesh::Face &face : state->mesh.faces)
  {
    if (face.boundary != boundary)
      continue;
    const auto cell = static_cast<std::size_t>(face.cell);
    const SolidLayer &layer =
        state->parameters
            .layers[static_cast<std::size_t>(state->mesh.layer[cell])];
    for (const FacePoint &point : face_points(state->mesh, face, 1))
    {
      const Vector along = far_springs(layer, point, origin);
      for (std::size_t v = 0; v < 4; ++v)
      {
        const auto node = static_cast<std::size_t>(face.corners[v]);
        springs[node].diagonal() += point.value[v] * point.area.norm() * along;
        is_there[node] = 1;
      }
    }
  }
  state->supports.collect(springs, is_there);
  state->bedding.resize(springs.size(), Matrix::Zero());
  for (std::size_t k = 0; k < springs.size(); ++k)
    state->bedding[k] += springs[k];
  state->update_dashpots(); // what was factored or hashed is stale
}

void Solid::set_initial_stress(
    const std::function<Voigt(const Vector &)> &stress)
{
  state->plastic.set_initial_stress(state->mesh, stress);
}

void Solid::set_load(std::span<const Vector> load)
{
  state->set_load(load);
  state->now.has_acceleration = false;
}

void Solid::begin_step(double time_step)
{
  check_solid_step(time_step);
  SolidMotion &now = state->now;
  now.has_acceleration = false;
  state->put_supports_in_motion();
  NodeField half = now.velocity;
  for (std::size_t k = 0; k < half.size(); ++k)
  {
    if (state->supports.is_hanging(k))
      continue;
    const Vector kick = 0.5 * time_step / state->mass[k] *
                        (state->force(k) - state->dashpot[k] * now.velocity[k]);
    for (int c = 0; c < 3; ++c)
      if (!state->supports.is_fixed(k, c))
        half[k](c) += kick(c);
    now.moved[k] = time_step * half[k];
    now.displacement[k] += now.moved[k];
  }
  state->book_half_step();
  now.velocity = half;
  state->supports.spread(now.velocity);
  state->supports.spread(now.displacement);
}

void Solid::end_step(std::span<const Vector> load, double time_step)
{
  check_solid_step(time_step);
  SolidMotion &now = state->now;
  state->set_load(load);
  state->update_forces();
  if (!std::isfinite(state->strain_energy()))
    throw std::runtime_error("solid: its strain energy is no longer finite; "
                             "is the time step above the stable one?");
  const double slow =
      1. / (1. + 0.5 * time_step * state->parameters.mass_damping);
  for (std::size_t k = 0; k < now.velocity.size(); ++k)
  {
    if (state->supports.is_hanging(k))
      continue;
    const double half = 0.5 * time_step / state->mass[k];
    Vector next = now.velocity[k] + half * state->force(k);
    if (state->has_absorber[k])
      next = (Matrix::Identity() + half * state->dashpot[k]).inverse() * next;
    else
      next *= slow;
    for (int c = 0; c < 3; ++c)
      if (!state->supports.is_fixed(k, c))
        now.velocity[k](c) = next(c);
  }
  state->book_half_step();
  state->supports.spread(now.velocity);
}

/// omega_max of M^(-1/2) K M^(-1/2) on what moves freely.
double Solid::State::largest_frequency() const
{
  const auto scale = [this](NodeField &field)
  {
    for (std::size_t k = 0; k < field.size(); ++k)
      for (int c = 0; c < 3; ++c)
        field[k](c) =
            supports.unknown(k, c) < 0 ? 0. : field[k](c) / std::sqrt(mass[k]);
  };
  const auto apply = [&](const NodeField &direction)
  {
    NodeField motion = direction, image(direction.size());
    scale(motion);
    supports.spread(motion);
    multiply(motion, image);
    scale(image);
    return image;
  };
  NodeField start = start_field(mass.size());
  scale(start);
  return std::sqrt(largest_eigenvalue(apply, start));
}

StepLimit Solid::stable_time_step() const
{
  auto [frequency, cell] = state->elastic.fastest_cell();
  // The largest eigenvalue of a sum is at most the sum of the largest ones.
  double bedded = 0.;
  for (std::size_t k = 0; k < state->bedding.size(); ++k)
    if (!state->supports.is_hanging(k))
      bedded = std::max(bedded, state->bedding[k].trace() / state->mass[k]);
  frequency = std::sqrt(frequency * frequency + bedded);
  const double beta = state->parameters.stiffness_damping;
  const auto longest = [beta](double omega)
  { return std::sqrt(beta * beta + 4. / (omega * omega)) - beta; };
  StepLimit limit;
  limit.guaranteed = longest(frequency);
  limit.time_step = longest(state->largest_frequency());
  Vector centre = Vector::Zero();
  for (const std::int32_t node : state->mesh.cells[cell])
    centre += state->mesh.nodes[static_cast<std::size_t>(node)] / 8.;
  limit.reason = "cell " + std::to_string(cell) + " of layer " +
                 std::to_string(state->mesh.layer[cell]) + " at (" +
                 std::to_string(centre.x()) + ", " +
                 std::to_string(centre.y()) + ", " +
                 std::to_string(centre.z()) + ") m, fastest mode " +
                 std::to_string(frequency) + " 1/s";
  return limit;
}

const SolidMesh &Solid::mesh() const
{
  return state->mesh;
}
std::span<const Vector> Solid::displacements() const
{
  return state->now.displacement;
}
std::span<const Vector> Solid::velocities() const
{
  return state->now.velocity;
}
std::span<const double> Solid::nodal_mass() const
{
  return state->mass;
}

SolidEnergy Solid::energy() const
{
  SolidEnergy energy = state->now.done;
  energy.strain = state->strain_energy();
  for (std::size_t k = 0; k < state->mass.size(); ++k)
    energy.kinetic +=
        0.5 * state->mass[k] * state->now.velocity[k].squaredNorm();
  return energy;
}

Vector Solid::reaction(std::int32_t node) const
{
  return state->force(checked_node(state->mesh, node));
}

std::array<double, 6> Solid::stress(std::size_t cell) const
{
  if (const auto s = state->plastic.mean_stress(cell, state->now.plastic))
    return {(*s)(0), (*s)(1), (*s)(2), (*s)(3), (*s)(4), (*s)(5)};
  if (const auto s = state->hyper.mean_stress(cell, state->now.displacement))
    return {(*s)(0), (*s)(1), (*s)(2), (*s)(3), (*s)(4), (*s)(5)};
  CellCorners corners;
  std::array<Vector, 8> displacement;
  for (std::size_t v = 0; v < 8; ++v)
  {
    const auto node = static_cast<std::size_t>(state->mesh.cells[cell][v]);
    corners[v] = state->mesh.nodes[node];
    displacement[v] = state->now.displacement[node];
  }
  const Eigen::Matrix<double, 6, 1> s = centre_stress(
      corners,
      state->parameters
          .layers[static_cast<std::size_t>(state->mesh.layer[cell])],
      displacement);
  return {s(0), s(1), s(2), s(3), s(4), s(5)};
}

double Solid::yielded_share() const
{
  return state->plastic.yielded_share(state->now.plastic);
}

void Solid::write_vtu(std::ostream &out) const
{
  const SolidMotion &now = state->now;
  SolidFields fields{now.displacement, now.velocity, now.load, {}};
  for (std::size_t k = 0; k < state->mesh.cells.size(); ++k)
    fields.stress.push_back(stress(k));
  write_solid_vtu(out, state->mesh, fields);
}
} // namespace fem
