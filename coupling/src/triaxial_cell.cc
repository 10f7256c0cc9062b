#include <coupling/triaxial_cell.h>
#include <dem/binary.h>
#include <dem/engine_boundaries.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace coupling
{
namespace
{
using Vector = Eigen::Vector3d;

std::vector<std::int32_t> rim(const fem::SurfaceMesh &mesh, bool is_upper)
{
  const auto [low, high] = std::minmax_element(
      mesh.nodes.begin(), mesh.nodes.end(),
      [](const auto &a, const auto &b) { return a.z() < b.z(); });
  return fem::nodes_at_height(mesh, is_upper ? high->z() : low->z(),
                              1e-6 * (high->z() - low->z()));
}
} // namespace

fem::Membrane tube_between_rims(const fem::MembraneParameters &parameters,
                                const fem::SurfaceMesh &mesh)
{
  fem::Membrane membrane(parameters, mesh);
  membrane.tie(rim(mesh, false));
  membrane.tie(rim(mesh, true));
  return membrane;
}

std::unique_ptr<InterfaceAdapter> adapter_of(const TriaxialCell &cell,
                                             std::size_t plane,
                                             const dem::WallMaterial &contact,
                                             dem::Engine &engine)
{
  auto top = std::make_unique<PlaneAdapter>(plane);
  if (!cell.has_membrane())
    return top;
  const fem::Membrane &membrane = cell.membrane();
  InterfaceMap map(membrane.mesh());
  const std::size_t number = dem::add_surface(
      engine, "membrane", contact,
      map.make_surface({membrane.positions(), membrane.velocities()},
                       movable_mass(membrane)));
  return std::make_unique<SplitAdapter>(
      std::make_unique<FacetAdapter>(std::move(map), number),
      membrane.n_nodes(), std::move(top));
}

TriaxialCell::TriaxialCell(double plate_mass, double height,
                           std::optional<fem::Membrane> membrane,
                           const BodySteps &steps)
    : DeformableBody(steps), tube(std::move(membrane)),
      upper_rim(tube ? rim(tube->mesh(), true) : std::vector<std::int32_t>{}),
      mass(plate_mass + rim_mass()), lid(mass, height)
{
  read_motion();
}

void TriaxialCell::set_plate(const fem::RigidPlate::State &state)
{
  lid.set_state(state);
  pressed = state.last_reaction - rim_reaction();
  read_motion();
}

void TriaxialCell::set_drive(double force)
{
  drive_from = lid.state().last_drive;
  drive_to = force;
  led.reset();
  step_in_window = 0;
}

void TriaxialCell::set_acceleration(double acceleration)
{
  led = acceleration;
}

void TriaxialCell::set_pressure(double pressure)
{
  tube.value().set_pressure(pressure);
}

void TriaxialCell::displace(FieldView shift)
{
  if (tube)
    tube->displace(shift.first(shift.size() - 1));
  fem::RigidPlate::State state = lid.state();
  state.z += shift.back().z();
  lid.set_state(state);
  read_motion();
}

double TriaxialCell::rim_reaction() const
{
  double sum = 0.;
  for (const std::int32_t node : upper_rim)
    sum += tube->reaction(node).z();
  return sum;
}

double TriaxialCell::rim_mass() const
{
  double sum = 0.;
  for (const std::int32_t node : upper_rim)
    sum += tube->nodal_mass()[static_cast<std::size_t>(node)];
  return sum;
}

std::vector<double> TriaxialCell::nodal_mass() const
{
  std::vector<double> masses;
  if (tube)
    masses = movable_mass(*tube);
  masses.push_back(mass);
  return masses;
}

void TriaxialCell::read_motion()
{
  position.clear();
  velocity.clear();
  if (tube)
  {
    position.assign(tube->positions().begin(), tube->positions().end());
    velocity.assign(tube->velocities().begin(), tube->velocities().end());
  }
  position.push_back(lid.height() * Vector::UnitZ());
  velocity.push_back(lid.velocity() * Vector::UnitZ());
}

void TriaxialCell::move_lid(double time_step)
{
  lid.begin_step(time_step);
  pushed += 0.5 * time_step * pressed * lid.velocity();
  for (const std::int32_t node : upper_rim)
    tube->set_tied_velocity(node, lid.velocity() * Vector::UnitZ());
}

void TriaxialCell::finish_lid(FieldView load, double time_step)
{
  pressed = load.back().z();
  pushed += 0.5 * time_step * pressed * lid.velocity();
  ++step_in_window;
  const double share = static_cast<double>(step_in_window) / n_steps();
  const double reaction = pressed + rim_reaction();
  lid.end_step(led ? mass * *led - reaction
                   : std::lerp(drive_from, drive_to, share),
               reaction, time_step);
  read_motion();
}

void TriaxialCell::begin_step(double time_step)
{
  move_lid(time_step);
  if (tube)
    tube->begin_step(time_step);
  read_motion();
}

void TriaxialCell::end_step(FieldView load, double time_step)
{
  if (tube)
    tube->end_step(load.first(load.size() - 1), time_step);
  finish_lid(load, time_step);
}

void TriaxialCell::start(FieldView load)
{
  if (tube)
    tube->set_load(load.first(load.size() - 1));
  step_in_window = 0;
  pressed = load.back().z();
  fem::RigidPlate::State state = lid.state();
  state.last_reaction = pressed + rim_reaction();
  if (led)
    state.last_drive = mass * *led - state.last_reaction;
  lid.set_state(state);
}

void TriaxialCell::step_tube(FieldView load, double time_step,
                             const fem::NodeSprings *springs)
{
  move_lid(time_step);
  if (tube)
    tube->advance(load.first(load.size() - 1), time_step,
                  fem::average_acceleration(), springs);
  finish_lid(load, time_step);
}

void TriaxialCell::implicit_step(FieldView load, double time_step)
{
  step_tube(load, time_step, nullptr);
}

void TriaxialCell::implicit_step(FieldView load, double time_step,
                                 const fem::NodeSprings &springs)
{
  step_tube(load, time_step, &springs);
}

double TriaxialCell::stable_time_step() const
{
  return tube ? tube->stable_time_step()
              : std::numeric_limits<double>::infinity();
}

/// The rim is the plate's.
BodyEnergy TriaxialCell::energy() const
{
  BodyEnergy energy;
  if (tube)
  {
    energy = energy_of(tube->energy());
    energy.kinetic -= 0.5 * rim_mass() * lid.velocity() * lid.velocity();
    energy.external = tube->energy().pressure_work;
  }
  energy.kinetic += lid.kinetic_energy();
  energy.external += lid.drive_work();
  energy.load_work += pushed;
  return energy;
}

void TriaxialCell::save(std::ostream &out) const
{
  if (tube)
    tube->save(out);
  dem::write_value(out, lid.state());
  for (const double value : {drive_from, drive_to, pressed, pushed})
    dem::write_value(out, value);
  dem::write_value(out, step_in_window);
}

void TriaxialCell::restore(std::istream &in)
{
  if (tube)
    tube->load(in);
  fem::RigidPlate::State state;
  dem::read_value(in, state);
  lid.set_state(state);
  for (double *value : {&drive_from, &drive_to, &pressed, &pushed})
    dem::read_value(in, *value);
  dem::read_value(in, step_in_window);
  read_motion();
}
} // namespace coupling
