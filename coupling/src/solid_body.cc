#include <coupling/solid_body.h>
#include <dem/binary.h>

#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

namespace coupling
{
namespace
{
/// Lumped mass of the nodes of a surface; infinite where there is none [kg].
std::vector<double> surface_mass(const fem::Solid &body,
                                 const fem::SolidSurface &surface)
{
  std::vector<double> mass;
  for (const std::int32_t node : surface.node)
  {
    const double own = body.nodal_mass()[static_cast<std::size_t>(node)];
    mass.push_back(own > 0. ? own : std::numeric_limits<double>::infinity());
  }
  return mass;
}

Eigen::Vector3d &at(Field &field, std::int32_t node)
{
  return field[static_cast<std::size_t>(node)];
}

/// Nodes of the body that move by themselves, and that touch what lies on it.
std::vector<std::int32_t> free_nodes(const fem::SolidSurface &surface)
{
  return {surface.node.begin(),
          surface.node.begin() + std::ptrdiff_t(surface.n_free())};
}
} // namespace

BodyEnergy energy_of(const fem::SolidEnergy &energy)
{
  return {energy.strain, energy.kinetic,
          energy.damping + energy.plastic + energy.absorbed,
          energy.support_work, energy.load_work};
}

SolidBody::SolidBody(fem::Solid its_solid, std::int32_t boundary,
                     const BodySteps &steps)
    : DeformableBody(steps), body(std::move(its_solid)),
      surface(fem::boundary_surface(body.mesh(), boundary)),
      position(surface.node.size()), velocity(position),
      dead_load(body.mesh().nodes.size(), Eigen::Vector3d::Zero()),
      body_load(dead_load)
{
  read_motion();
}

void SolidBody::set_dead_load(Field load)
{
  if (load.size() != dead_load.size())
    throw std::invalid_argument("solid body: " + std::to_string(load.size()) +
                                " dead loads for " +
                                std::to_string(dead_load.size()) + " nodes");
  dead_load = std::move(load);
  dead_start = dead_potential();
  body.set_load(dead_load);
}

void SolidBody::set_drive(SolidDrive its_drive)
{
  if (its_drive.share.size() != dead_load.size())
    throw std::invalid_argument(
        "solid body: drive on " + std::to_string(its_drive.share.size()) +
        " nodes of " + std::to_string(dead_load.size()));
  drive = std::move(its_drive);
  body.set_load(on_body(Field(position.size(), Eigen::Vector3d::Zero())));
}

void SolidBody::start_books()
{
  if (!drive.force)
    return;
  before.clear();
  for (const std::int32_t node : surface.node)
    before.push_back(body.displacements()[static_cast<std::size_t>(node)]);
}

/// Half of the work of this load of the particles since start_books. That of
/// the drive is what all loads do besides.
void SolidBody::book(FieldView load)
{
  if (!drive.force)
    return;
  for (std::size_t k = 0; k < load.size(); ++k)
    driven.work +=
        0.5 *
        load[k].dot(
            body.displacements()[static_cast<std::size_t>(surface.node[k])] -
            before[k]);
}

void SolidBody::balance(FieldView load)
{
  Field held(dead_load.size(), Eigen::Vector3d::Zero());
  fem::add_loads(surface, load, held);
  body.start_under(held);
  for (Eigen::Vector3d &force : held)
    force = -force;
  set_dead_load(std::move(held));
}

double SolidBody::dead_potential() const
{
  double sum = 0.;
  for (std::size_t k = 0; k < dead_load.size(); ++k)
    sum += dead_load[k].dot(body.displacements()[k]);
  return sum;
}

BodyEnergy SolidBody::energy() const
{
  BodyEnergy energy = energy_of(body.energy());
  const double dead = dead_potential() - dead_start;
  const double others = drive.force ? energy.load_work - driven.work : dead;
  energy.load_work -= others;
  energy.external += others;
  return energy;
}

std::vector<double> SolidBody::nodal_mass() const
{
  return surface_mass(body, surface);
}

FieldView SolidBody::on_body(FieldView load)
{
  body_load = dead_load;
  if (drive.force)
  {
    const double force = drive.force(driven.time);
    for (std::size_t k = 0; k < drive.share.size(); ++k)
      body_load[k].z() += drive.share[k] * force;
    touching.assign(load.begin(), load.end());
  }
  fem::add_loads(surface, load, body_load);
  return body_load;
}

void SolidBody::read_motion()
{
  fem::send_motion(body, surface, position, velocity);
}

void SolidBody::begin_step(double time_step)
{
  start_books();
  body.begin_step(time_step);
  book(touching);
  driven.time += time_step;
  read_motion();
}

void SolidBody::end_step(FieldView load, double time_step)
{
  body.end_step(on_body(load), time_step);
  book(load);
  read_motion();
}

void SolidBody::save(std::ostream &out) const
{
  body.save(out);
  dem::write_value(out, driven);
  dem::write_column(out, touching);
}

void SolidBody::restore(std::istream &in)
{
  body.load(in);
  dem::read_value(in, driven);
  dem::read_column(in, touching);
  read_motion();
}

void SolidBody::start(FieldView load)
{
  body.set_load(on_body(load));
}

void SolidBody::implicit_step(FieldView load, double time_step)
{
  start_books();
  const Field at_start = touching;
  driven.time += time_step;
  body.advance(on_body(load), time_step);
  book(at_start);
  book(load);
  read_motion();
}

CondensedBody::CondensedBody(const fem::Solid &body, std::int32_t boundary,
                             int n_inner_modes, int n_steps, double window)
    : DeformableBody({true, n_steps}),
      surface(fem::boundary_surface(body.mesh(), boundary)),
      reduced(body, {free_nodes(surface), n_inner_modes, window / n_steps}),
      mass(surface_mass(body, surface)), own_step(window / n_steps)
{
  read_motion();
}

void CondensedBody::read_motion()
{
  position = surface.mesh.nodes;
  velocity.resize(position.size());
  for (std::size_t k = 0; k < surface.n_free(); ++k)
  {
    position[k] += reduced.displacements()[k];
    velocity[k] = reduced.velocities()[k];
  }
  for (const auto &[node, ends] : surface.mesh.midpoints)
    for (Field *field : {&position, &velocity})
      at(*field, node) = 0.5 * (at(*field, ends[0]) + at(*field, ends[1]));
}

void CondensedBody::balance(FieldView load)
{
  if (load.size() != position.size())
    throw std::invalid_argument(
        "condensed body: " + std::to_string(load.size()) + " loads for " +
        std::to_string(position.size()) + " nodes");
  const FieldView on_nodes = load.first(surface.n_free());
  rest_load.assign(on_nodes.begin(), on_nodes.end());
  rest_start = rest_potential();
  reduced.set_load(Field(on_nodes.size(), Eigen::Vector3d::Zero()));
}

double CondensedBody::rest_potential() const
{
  double sum = 0.;
  for (std::size_t k = 0; k < rest_load.size(); ++k)
    sum -= rest_load[k].dot(reduced.displacements()[k]);
  return sum;
}

FieldView CondensedBody::excess(FieldView load)
{
  const FieldView on_nodes = load.first(surface.n_free());
  acting.assign(on_nodes.begin(), on_nodes.end());
  for (std::size_t k = 0; k < rest_load.size(); ++k)
    acting[k] -= rest_load[k];
  return acting;
}

BodyEnergy CondensedBody::energy() const
{
  BodyEnergy energy = energy_of(reduced.energy());
  const double rest = rest_potential() - rest_start;
  energy.load_work -= rest;
  energy.external += rest;
  return energy;
}

void CondensedBody::begin_step(double)
{
  throw std::logic_error("condensed body: has implicit steps only");
}

void CondensedBody::end_step(FieldView, double time_step)
{
  begin_step(time_step);
}

double CondensedBody::stable_time_step() const
{
  return std::numeric_limits<double>::infinity();
}

void CondensedBody::implicit_step(FieldView load, double time_step)
{
  if (std::abs(time_step - own_step) > 1e-9 * own_step)
    throw std::invalid_argument(
        "condensed body: step " + std::to_string(time_step) +
        " s, was built for " + std::to_string(own_step) + " s");
  reduced.advance(excess(load));
  read_motion();
}

void CondensedBody::restore(std::istream &in)
{
  reduced.load(in);
  read_motion();
}
} // namespace coupling
