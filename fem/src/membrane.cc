#include "enclosed_volume.h"
#include "membrane_state.h"
#include "mesh_checks.h"
#include "stable_step.h"

#include <cmath>
#include <limits>
#include <stdexcept>

namespace fem
{
namespace
{
using Vector = Eigen::Vector3d;

void require(bool condition, const std::string &what, double value,
             const std::string &allowed)
{
  if (!condition)
    throw std::invalid_argument("membrane: " + what + " = " +
                                std::to_string(value) + ", " + allowed);
}

void check_parameters(const MembraneParameters &p)
{
  const auto positive = [](const char *what, double value)
  {
    require(std::isfinite(value) && value > 0., what, value,
            "must be positive");
  };
  positive("youngs_modulus", p.youngs_modulus);
  positive("thickness", p.thickness);
  positive("density", p.density);
  require(p.poisson_ratio > -1. && p.poisson_ratio <= 0.5, "poisson_ratio",
          p.poisson_ratio, "must be above -1 and at most 0.5");
  require(p.law != MembraneLaw::neo_hooke || p.poisson_ratio == 0.5,
          "poisson_ratio", p.poisson_ratio,
          "must be 0.5 with the neo-Hookean law, which is incompressible");
  require(std::isfinite(p.tension) && p.tension >= 0., "tension", p.tension,
          "must not be negative");
  require(p.residual_stiffness >= 0. && p.residual_stiffness < 1.,
          "residual_stiffness", p.residual_stiffness,
          "must be 0 or above and below 1");
  require(std::isfinite(p.mass_damping) && p.mass_damping >= 0., "mass_damping",
          p.mass_damping, "must not be negative");
}

/// Passes the mesh on, so that it is checked before deal.II sees it.
const SurfaceMesh &checked(const SurfaceMesh &mesh)
{
  check_mesh(mesh);
  return mesh;
}

std::vector<HangingNode> hanging_nodes(const SurfaceMesh &mesh)
{
  std::vector<HangingNode> nodes;
  for (const SurfaceMesh::Midpoint &middle : mesh.midpoints)
    nodes.push_back(
        {middle.node, {{middle.ends[0], 0.5}, {middle.ends[1], 0.5}}});
  return nodes;
}

Sheet make_sheet(const MembraneParameters &p, const MembraneSpace &space)
{
  check_parameters(p);
  Sheet sheet = space.make_sheet();
  sheet.material.stiffness =
      p.youngs_modulus * p.thickness / (1. - p.poisson_ratio * p.poisson_ratio);
  sheet.material.poisson_ratio = p.poisson_ratio;
  if (p.law == MembraneLaw::neo_hooke)
    sheet.material.shear = p.youngs_modulus * p.thickness / 3.;
  sheet.material.tension = p.tension;
  sheet.material.has_wrinkles = p.wrinkling == MembraneWrinkling::tension_field;
  sheet.material.residual = p.residual_stiffness;
  return sheet;
}

} // namespace

void check_membrane_step(double time_step)
{
  require(std::isfinite(time_step) && time_step > 0., "time step", time_step,
          "must be positive");
}

void check_membrane_size(const char *what, std::size_t given,
                         std::size_t n_nodes)
{
  if (given != n_nodes)
    throw std::invalid_argument("membrane: " + std::to_string(given) + " " +
                                what + " for " + std::to_string(n_nodes) +
                                " nodes");
}

Membrane::State::State(const MembraneParameters &p,
                       const SurfaceMesh &reference)
    : parameters(p), mesh(checked(reference)), space(mesh),
      midpoints(hanging_nodes(mesh), mesh.nodes.size()), rims(find_rims(mesh)),
      identity(fingerprint(p, mesh)), sheet(make_sheet(p, space)),
      batched(sheet), mass(space.nodal_area())
{
  for (double &m : mass)
    m *= p.density * p.thickness;
  midpoints.collect(mass);
  now.tied.assign(mesh.nodes.size(), 0);
  start_from(mesh.nodes);
}

std::size_t Membrane::State::checked_node(std::int32_t node) const
{
  require(node >= 0 && static_cast<std::size_t>(node) < mass.size(), "node",
          node, "must be below " + std::to_string(mass.size()));
  return static_cast<std::size_t>(node);
}

std::size_t Membrane::State::tied_node(std::int32_t node) const
{
  const std::size_t k = checked_node(node);
  require(now.tied[k] != 0, "node", node, "is not tied");
  return k;
}

/// All but mass damping.
Vector Membrane::State::force(std::size_t k) const
{
  return now.forces.internal[k] - now.pressure * now.forces.area[k] +
         now.load[k];
}

/// Whoever sets the velocity of a node does the work that its mass takes.
void Membrane::State::set_velocity(std::size_t k, const Vector &velocity)
{
  now.done.tie_work +=
      0.5 * mass[k] * (velocity.squaredNorm() - now.velocity[k].squaredNorm());
  now.velocity[k] = velocity;
}

/// Half the work of the present forces over the motion of the step. Both halves
/// together are the trapezoidal rule: with it velocity Verlet keeps
/// the balance but for dt^2 (|f_end|^2 - |f_begin|^2) / (8 m), which does not
/// add up, and the cubic error of the strain energy in one step.
void Membrane::State::book_half_step(std::size_t k)
{
  const Vector half = 0.5 * now.moved[k];
  now.done.pressure_work -= now.pressure * half.dot(now.forces.area[k]);
  now.done.contact_work += half.dot(now.load[k]);
  if (now.tied[k] != 0)
    now.done.tie_work -= half.dot(tied_along(k, force(k)));
  if (now.tied[k] != all_axes)
    now.done.damping += parameters.mass_damping * mass[k] *
                        half.dot(free_along(k, now.velocity[k]));
}

void Membrane::State::start_from(std::span<const Vector> positions)
{
  const std::vector<Vector> zeros(positions.size(), Vector::Zero());
  now.position.assign(positions.begin(), positions.end());
  midpoints.spread(now.position);
  now.velocity = now.moved = now.load = now.acceleration = zeros;
  now.has_acceleration = 0;
  now.done = MembraneEnergy();
  find_forces();
}

void Membrane::State::take_load(std::span<const Vector> load)
{
  std::copy(load.begin(), load.end(), now.load.begin());
  midpoints.collect(now.load);
}

void Membrane::State::find_forces()
{
  evaluate_forces(batched, now.position, now.forces);
  midpoints.collect(now.forces.internal);
  midpoints.collect(now.forces.area);
}

Membrane::Membrane(const MembraneParameters &parameters,
                   const SurfaceMesh &reference)
    : state(std::make_unique<State>(parameters, reference))
{
}
Membrane::~Membrane() = default;
Membrane::Membrane(Membrane &&) noexcept = default;

void Membrane::tie(const std::vector<std::int32_t> &nodes, const TiedAxes &axes)
{
  MembraneMotion &now = state->now;
  for (const std::int32_t node : nodes)
  {
    const std::size_t k = state->checked_node(node);
    std::uint8_t fresh = 0;
    for (int c = 0; c < 3; ++c)
      if (axes[static_cast<std::size_t>(c)] && !is_tied_along(now.tied[k], c))
        fresh = static_cast<std::uint8_t>(fresh | 1 << c);
    if (fresh == 0 || !state->is_free(k))
      continue;
    now.tied[k] = static_cast<std::uint8_t>(now.tied[k] | fresh);
    now.acceleration[k] = free_part(fresh, now.acceleration[k]);
    state->set_velocity(k, free_part(fresh, now.velocity[k]));
  }
}

void Membrane::set_tied_velocity(std::int32_t node, const Vector &velocity)
{
  const std::size_t k = state->tied_node(node);
  state->set_velocity(k, state->tied_along(k, velocity) +
                             state->free_along(k, state->now.velocity[k]));
}

void Membrane::set_pressure(double pressure)
{
  require(std::isfinite(pressure), "pressure", pressure, "must be finite");
  state->now.pressure = pressure;
}

void Membrane::set_positions(std::span<const Vector> positions)
{
  check_membrane_size("positions", positions.size(), n_nodes());
  for (const Vector &position : positions)
    if (!position.allFinite())
      throw std::invalid_argument("membrane: a position is not finite");
  state->start_from(positions);
}

void Membrane::displace(std::span<const Vector> shift)
{
  check_membrane_size("shifts", shift.size(), n_nodes());
  MembraneMotion &now = state->now;
  for (std::size_t k = 0; k < n_nodes(); ++k)
    now.position[k] += shift[k];
  state->midpoints.spread(now.position);
  now.has_acceleration = 0;
  state->find_forces();
}

void Membrane::set_load(std::span<const Vector> load)
{
  check_membrane_size("loads", load.size(), n_nodes());
  state->take_load(load);
  state->now.has_acceleration = 0;
}

void Membrane::begin_step(double time_step)
{
  check_membrane_step(time_step);
  MembraneMotion &now = state->now;
  now.has_acceleration = 0;
  for (std::size_t k = 0; k < n_nodes(); ++k)
  {
    const Vector start = now.velocity[k];
    Vector half = start;
    if (state->is_free(k))
      half += 0.5 * time_step *
              state->free_along(k, state->force(k) / state->mass[k] -
                                       state->parameters.mass_damping * start);
    now.moved[k] = time_step * half;
    state->book_half_step(k);
    now.velocity[k] = half;
    now.position[k] += now.moved[k];
  }
  state->midpoints.spread(now.velocity);
  state->midpoints.spread(now.position);
}

void Membrane::end_step(std::span<const Vector> load, double time_step)
{
  check_membrane_step(time_step);
  check_membrane_size("loads", load.size(), n_nodes());
  MembraneMotion &now = state->now;
  state->take_load(load);
  state->find_forces();
  if (!std::isfinite(now.forces.strain_energy))
    throw std::runtime_error("membrane: its strain energy is no longer "
                             "finite; is the time step above the stable one?");

  // Explicit damping in the first half, implicit in the second: the factor
  // (1 - alpha dt / 2) / (1 + alpha dt / 2) per step stays below one.
  const double slow =
      1. / (1. + 0.5 * time_step * state->parameters.mass_damping);
  for (std::size_t k = 0; k < n_nodes(); ++k)
  {
    if (state->is_free(k))
      now.velocity[k] =
          state->tied_along(k, now.velocity[k]) +
          slow * state->free_along(k, now.velocity[k] + 0.5 * time_step /
                                                            state->mass[k] *
                                                            state->force(k));
    state->book_half_step(k);
  }
  state->midpoints.spread(now.velocity);
}

double Membrane::stable_time_step() const
{
  Sheet taut = state->sheet;
  taut.material.has_wrinkles = false;
  const double frequency =
      largest_frequency(taut, {state->mass, state->now.tied, state->midpoints},
                        state->now.position, state->now.pressure);
  return frequency > 0. ? 2. / frequency
                        : std::numeric_limits<double>::infinity();
}

std::size_t Membrane::n_nodes() const
{
  return state->mass.size();
}

std::span<const Vector> Membrane::positions() const
{
  return state->now.position;
}

std::span<const Vector> Membrane::velocities() const
{
  return state->now.velocity;
}

std::span<const double> Membrane::nodal_mass() const
{
  return state->mass;
}

bool Membrane::is_tied(std::int32_t node) const
{
  return state->now.tied[state->checked_node(node)] == all_axes;
}

TiedAxes Membrane::tied_axes(std::int32_t node) const
{
  const std::uint8_t axes = state->now.tied[state->checked_node(node)];
  return {is_tied_along(axes, 0), is_tied_along(axes, 1),
          is_tied_along(axes, 2)};
}

const SurfaceMesh &Membrane::mesh() const
{
  return state->mesh;
}

Vector Membrane::reaction(std::int32_t node) const
{
  const std::size_t k = state->tied_node(node);
  return state->tied_along(k, state->force(k));
}

Vector Membrane::force(std::int32_t node) const
{
  return state->force(state->checked_node(node));
}

Eigen::Matrix3d Membrane::stress_integral() const
{
  return fem::stress_integral(state->sheet, state->now.position);
}

double Membrane::wrinkled_share() const
{
  return fem::wrinkled_share(state->sheet, state->now.position);
}

double Membrane::unbalanced_force_ratio() const
{
  double largest = 0.;
  for (std::size_t k = 0; k < n_nodes(); ++k)
    if (state->now.tied[k] != all_axes)
      largest = std::max(largest, state->free_along(k, state->force(k)).norm());
  if (largest == 0.)
    return 0.;
  return largest / mean_element_force(state->sheet, state->now.position);
}

MembraneEnergy Membrane::energy() const
{
  MembraneEnergy energy = state->now.done;
  energy.strain = state->now.forces.strain_energy;
  energy.kinetic = 0.;
  for (std::size_t k = 0; k < n_nodes(); ++k)
    energy.kinetic +=
        0.5 * state->mass[k] * state->now.velocity[k].squaredNorm();
  return energy;
}

double Membrane::enclosed_volume() const
{
  return fem::enclosed_volume(state->mesh, state->rims, state->now.position);
}

void Membrane::write_vtu(std::ostream &out) const
{
  const MembraneMotion &now = state->now;
  state->space.write_vtu(out, state->sheet,
                         {now.position, now.velocity, now.load});
}

void Membrane::save(std::ostream &out) const
{
  save_motion(out, state->identity, state->now);
}

void Membrane::load(std::istream &in)
{
  state->now = load_motion(in, state->identity, n_nodes());
}
} // namespace fem
