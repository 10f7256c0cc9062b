// The engine, its particles as numpy views, its walls as small handles.
#include "bindings.h"

#include <dem/breakage/events.h>
#include <dem/engine_boundaries.h>
#include <dem/integrate/time_step.h>
#include <dem/measure/assembly.h>
#include <dem/measure/network.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <pybind11/eigen.h>
#include <pybind11/functional.h>
#include <pybind11/numpy.h>
#include <pybind11/stl.h>
#include <stdexcept>

namespace py = pybind11;
using dem::Vec3;

namespace
{
using Series = std::shared_ptr<const dem::Coefficients>;

/// An engine and the shapes that its particles share, in order of their use:
/// what a checkpoint refers to.
struct PyEngine
{
  dem::Engine engine;
  std::vector<Series> shapes = {};

  explicit PyEngine(const dem::EngineParameters &parameters)
      : engine((check_parameters(parameters), parameters))
  {
  }
  void note(const Series &series)
  {
    for (const Series &known : shapes)
      if (known == series)
        return;
    shapes.push_back(series);
  }
};

/// Columns of `n_columns` doubles that begin at `first` in rows of `Row`; the
/// memory belongs to `owner`.
template <class Row>
py::array view(const py::object &owner, std::vector<Row> &rows,
               std::ptrdiff_t offset, py::ssize_t n_columns, bool is_writeable)
{
  const auto n = static_cast<py::ssize_t>(rows.size());
  constexpr py::ssize_t row_size = sizeof(Row), value = sizeof(double);
  static double nothing = 0.;
  auto *first = rows.empty()
                    ? &nothing
                    : reinterpret_cast<double *>(
                          reinterpret_cast<char *>(rows.data()) + offset);
  std::vector<py::ssize_t> shape = {n}, strides = {row_size};
  if (n_columns > 1)
  {
    shape.push_back(n_columns);
    strides.push_back(value);
  }
  py::array all(py::dtype::of<double>(), shape, strides, first, owner);
  if (!is_writeable)
    all.attr("setflags")(py::arg("write") = false);
  return all;
}

template <auto field>
std::ptrdiff_t offset_of()
{
  static const dem::ParticleState one;
  return reinterpret_cast<const char *>(&(one.*field)) -
         reinterpret_cast<const char *>(&one);
}

/// A column of the particles' state.
template <auto field, int n_columns, bool is_writeable = true>
py::array state_column(const py::object &self)
{
  auto &engine = self.cast<PyEngine &>().engine;
  return view(self, engine.particles().state, offset_of<field>(), n_columns,
              is_writeable);
}

py::array load_column(const py::object &self, bool is_moment)
{
  auto &particles = self.cast<PyEngine &>().engine.particles();
  return view(self, particles.load, is_moment ? sizeof(Vec3) : 0, 3, false);
}

dem::Quaternion quaternion(const std::array<double, 4> &wxyz)
{
  const dem::Quaternion q(wxyz[0], wxyz[1], wxyz[2], wxyz[3]);
  if (!(q.norm() > 0.) || !std::isfinite(q.norm()))
    throw std::invalid_argument("orientation: must be four numbers w, x, y, z "
                                "that are not all 0");
  return q.normalized();
}

std::int64_t add(PyEngine &self, const dem::ParticleShape &shape,
                 const Vec3 &position, const dem::Quaternion &orientation,
                 const Vec3 &velocity, const Vec3 &spin)
{
  require_finite("position", position);
  require_finite("velocity", velocity);
  require_finite("spin", spin);
  const auto id = static_cast<std::int64_t>(self.engine.particles().size());
  if (shape.series)
    self.note(shape.series);
  self.engine.add_particle(shape, position, orientation);
  dem::ParticleSystem &particles = self.engine.particles();
  const std::size_t row = particles.size() - 1;
  particles.velocity(row) = velocity;
  particles.spin(row) = spin;
  return id;
}

double stable_step(PyEngine &self)
{
  if (self.engine.particles().size() == 0)
    throw std::invalid_argument("no particles: the stable step follows from "
                                "their masses, add one before");
  return dem::critical_step(self.engine.parameters(), self.engine.particles())
      .step;
}

/// Steps, and after every `interval` of them the callback; Ctrl-C stops
/// between two of them.
void advance(PyEngine &self, double time_step, std::int64_t n_steps,
             const std::function<void()> &callback, std::int64_t interval)
{
  if (!(time_step > 0.) || !std::isfinite(time_step))
    throw std::invalid_argument("time_step: must be above 0 s and finite");
  if (n_steps < 0 || interval < 1)
    throw std::invalid_argument("n_steps must be at least 0, interval at "
                                "least 1");
  for (std::int64_t step = 1; step <= n_steps; ++step)
  {
    self.engine.advance(time_step);
    if (callback && step % interval == 0)
      callback();
    if (step % 64 == 0 && PyErr_CheckSignals() != 0)
      throw py::error_already_set();
  }
}

py::dict energy(const PyEngine &self)
{
  const dem::EngineEnergy now = self.engine.energy();
  py::dict all;
  all["kinetic"] = now.kinetic;
  all["elastic"] = now.elastic;
  all["friction"] = now.friction;
  all["rolling"] = now.rolling;
  all["damping"] = now.damping;
  all["breakage"] = now.breakage;
  all["non_conservative_work"] = now.non_conservative_work;
  all["gravity_work"] = now.gravity_work;
  all["cell_work"] = now.cell_work;
  for (const auto &[kind, work] : now.boundary_work)
    all[("work_of_" + kind).c_str()] = work;
  return all;
}

template <class Value, class Contacts, class Get>
py::array_t<Value> column_of(const Contacts &contacts, const Get &get,
                             py::ssize_t n_columns)
{
  const auto n = static_cast<py::ssize_t>(contacts.size());
  py::array_t<Value> column(n_columns > 1
                                ? std::vector<py::ssize_t>{n, n_columns}
                                : std::vector<py::ssize_t>{n});
  Value *out = column.mutable_data();
  for (const auto &contact : contacts)
    for (py::ssize_t d = 0; d < n_columns; ++d)
      *out++ = get(contact, d);
  return column;
}

/// Touching pairs: ids of both particles, point, force on the first one.
py::dict contacts(const PyEngine &self)
{
  const dem::Network network = dem::contact_network_of(self.engine);
  const dem::ParticleSystem &particles = self.engine.particles();
  using Pair = dem::PairContact;
  const auto id = [&](std::int32_t row)
  { return particles.id[static_cast<std::size_t>(row)]; };
  py::dict all;
  all["a"] = column_of<std::int64_t>(
      network.pairs, [&](const Pair &c, py::ssize_t) { return id(c.a); }, 1);
  all["b"] = column_of<std::int64_t>(
      network.pairs, [&](const Pair &c, py::ssize_t) { return id(c.b); }, 1);
  all["point"] = column_of<double>(
      network.pairs, [](const Pair &c, py::ssize_t d) { return c.point[d]; },
      3);
  all["force"] = column_of<double>(
      network.pairs, [](const Pair &c, py::ssize_t d) { return c.force[d]; },
      3);
  return all;
}

void save(const PyEngine &self, const std::string &file)
{
  const std::string part = file + ".part"; // an earlier file stays whole
  std::ofstream out(part, std::ios::binary);
  self.engine.save(out, self.shapes,
                   self.engine.is_shareable() ? dem::StateExtent::scene
                                              : dem::StateExtent::rank);
  out.close();
  if (!out)
    throw std::runtime_error(part + ": cannot be written");
  std::filesystem::rename(part, file);
}

void restore(PyEngine &self, const std::string &file)
{
  std::ifstream in(file, std::ios::binary);
  if (!in)
    throw std::runtime_error(file + ": cannot be read");
  self.engine.restore(in, self.shapes);
}

/// A plane of an engine by its number.
struct PyPlane
{
  PyEngine *engine;
  std::size_t number;

  dem::Plane &operator()() const { return dem::planes(engine->engine)[number]; }
};

/// A mesh wall of an engine by its number.
struct PyMeshWall
{
  PyEngine *engine;
  std::size_t number;

  const dem::MeshWall &operator()() const
  {
    return dem::mesh_walls(engine->engine)[number];
  }
};

PyPlane add_plane(PyEngine &self, const Vec3 &point, const Vec3 &normal)
{
  require_finite("point", point);
  require_finite("normal", normal);
  if (!(normal.norm() > 0.))
    throw std::invalid_argument("normal: must not be 0");
  return {&self, dem::add_plane(self.engine, point, normal.normalized())};
}

PyMeshWall add_mesh_wall(PyEngine &self, const std::string &name,
                         const std::vector<Vec3> &vertices,
                         const std::vector<std::array<std::int32_t, 3>> &facets,
                         const Vec3 &velocity, double spin, const Vec3 &axis,
                         const Vec3 &centre)
{
  require_finite("velocity", velocity);
  require_finite("spin", {spin, 0., 0.});
  require_finite("axis", axis);
  require_finite("centre", centre);
  for (std::size_t k = 0; k < vertices.size(); ++k)
    require_finite("vertices[" + std::to_string(k) + "]", vertices[k]);
  if (!(axis.norm() > 0.))
    throw std::invalid_argument("axis: must not be 0");
  dem::FacetSurface surface;
  surface.position = vertices;
  surface.triangles = facets;
  surface.velocity.assign(vertices.size(), Vec3::Zero());
  surface.load.assign(vertices.size(), Vec3::Zero());
  surface.mass.assign(vertices.size(), std::numeric_limits<double>::infinity());
  dem::WallMotion motion;
  motion.velocity = velocity;
  motion.spin = spin;
  motion.axis = axis.normalized();
  motion.centre = centre;
  return {&self, dem::add_mesh_wall(self.engine, name,
                                    self.engine.parameters().surface,
                                    std::move(surface), motion)};
}

void bind_walls(py::module_ &module)
{
  py::class_<PyPlane>(module, "Plane", "A rigid plane.")
      .def_property(
          "point", [](const PyPlane &p) { return p().point; },
          [](const PyPlane &p, const Vec3 &point)
          {
            require_finite("point", point);
            dem::place_plane(p.engine->engine, p.number, point);
          },
          "A point of the plane [m].")
      .def_property_readonly(
          "normal", [](const PyPlane &p) { return p().normal; },
          "Unit normal into the particles [-].")
      .def_property(
          "velocity", [](const PyPlane &p) { return p().velocity; },
          [](const PyPlane &p, const Vec3 &v)
          {
            require_finite("velocity", v);
            p().velocity = v;
          },
          "Velocity [m/s]; read as a copy, set as a whole.")
      .def_property_readonly(
          "force", [](const PyPlane &p) { return p().force; },
          "Force of the particles on the plane [N].")
      .def_property_readonly(
          "work", [](const PyPlane &p) { return p().work; },
          "Work done on the particles [J].");
  py::class_<PyMeshWall>(module, "MeshWall", "A rigid wall of triangles.")
      .def_property_readonly(
          "force", [](const PyMeshWall &w) { return w().load().force; },
          "Force of the particles on the wall [N].")
      .def_property_readonly(
          "moment", [](const PyMeshWall &w) { return w().load().moment; },
          "Their moment about its centre of rotation [N m].");
}

void bind_columns(py::class_<PyEngine> &engine)
{
  using State = dem::ParticleState;
  engine
      .def_property_readonly("position", &state_column<&State::position, 3>,
                             "Positions, a view of n x 3 [m].")
      .def_property_readonly("velocity", &state_column<&State::velocity, 3>,
                             "Velocities, a view of n x 3 [m/s].")
      .def_property_readonly("spin", &state_column<&State::spin, 3>,
                             "Angular velocities, a view of n x 3 [rad/s].")
      .def_property_readonly(
          "orientation", &state_column<&State::orientation, 4>,
          "Quaternions body to world as x, y, z, w, a view of n x 4.")
      .def_property_readonly("radius", &state_column<&State::radius, 1, false>,
                             "Radii of the equivalent spheres, read-only [m].")
      .def_property_readonly("mass", &state_column<&State::mass, 1, false>,
                             "Masses, read-only [kg].")
      .def_property_readonly(
          "force",
          [](const py::object &self) { return load_column(self, false); },
          "Forces of the contacts, read-only view of n x 3 [N].")
      .def_property_readonly(
          "moment",
          [](const py::object &self) { return load_column(self, true); },
          "Moments of the contacts, read-only view of n x 3 [N m].")
      .def_property_readonly(
          "id",
          [](PyEngine &self)
          {
            const auto &id = self.engine.particles().id;
            return py::array_t<std::int64_t>(
                static_cast<py::ssize_t>(id.size()), id.data());
          },
          "Ids of the particles by row, a copy: rows change their order, ids "
          "do not.");
}

void bind_steps(py::class_<PyEngine> &engine)
{
  engine
      .def("advance", &advance, py::arg("time_step"), py::arg("n_steps") = 1,
           py::arg("callback") = nullptr, py::arg("interval") = 1,
           "Takes steps of this length [s]; calls callback() after every "
           "`interval` of them.")
      .def("stable_step", &stable_step,
           "Longest stable step of any particle on any other or a plane [s].")
      .def_property_readonly(
          "time", [](const PyEngine &self) { return self.engine.time(); },
          "Time [s].")
      .def_property_readonly("n_steps", [](const PyEngine &self)
                             { return self.engine.n_steps(); })
      .def("energy", &energy, "Energies now and done so far, by name [J].")
      .def("contacts", &contacts,
           "Touching pairs of particles: ids a and b, point [m], force on a "
           "[N], as arrays.")
      .def(
          "unbalanced_force_ratio",
          [](const PyEngine &self)
          { return dem::unbalanced_force_ratio(self.engine); },
          "Mean resultant force on a particle over the mean contact force [-].")
      .def(
          "set_breaking",
          [](PyEngine &self, bool is_on) { self.engine.set_breaking(is_on); },
          py::arg("is_on"), "Whether particles break from now on.")
      .def_property_readonly(
          "n_events",
          [](const PyEngine &self) { return self.engine.n_events(); },
          "Number of breakage events so far.")
      .def("save", &save, py::arg("file"),
           "Writes the whole state, bit for bit.")
      .def("restore", &restore, py::arg("file"),
           "Reads it into an engine with the same parameters and shapes.");
}
} // namespace

void bind_engine(py::module_ &module)
{
  bind_walls(module);
  py::class_<PyEngine> engine(
      module, "Engine",
      "Particles, their contacts and walls, and how they move.");
  engine.def(py::init<const dem::EngineParameters &>(), py::arg("parameters"))
      .def("__len__",
           [](PyEngine &self) { return self.engine.particles().size(); })
      .def(
          "add_sphere",
          [](PyEngine &self, double radius, const Vec3 &position,
             const Vec3 &velocity, const Vec3 &spin)
          {
            require_length("radius", radius);
            return add(self, dem::make_sphere(radius), position,
                       dem::Quaternion::Identity(), velocity, spin);
          },
          py::arg("radius"), py::arg("position"),
          py::arg("velocity") = Vec3(Vec3::Zero()),
          py::arg("spin") = Vec3(Vec3::Zero()),
          "Adds a sphere [m]; returns its id.")
      .def(
          "add_particle",
          [](PyEngine &self, const dem::ParticleShape &shape,
             const Vec3 &position, const std::array<double, 4> &orientation,
             const Vec3 &velocity, const Vec3 &spin) {
            return add(self, shape, position, quaternion(orientation), velocity,
                       spin);
          },
          py::arg("shape"), py::arg("position"),
          py::arg("orientation") = std::array<double, 4>{1., 0., 0., 0.},
          py::arg("velocity") = Vec3(Vec3::Zero()),
          py::arg("spin") = Vec3(Vec3::Zero()),
          "Adds a particle of a shape, turned by the quaternion w, x, y, z; "
          "returns its id.")
      .def("add_plane", &add_plane, py::arg("point"), py::arg("normal"),
           py::keep_alive<0, 1>(),
           "Adds a rigid plane, normal into the particles.")
      .def("add_mesh_wall", &add_mesh_wall, py::arg("name"),
           py::arg("vertices"), py::arg("triangles"),
           py::arg("velocity") = Vec3(Vec3::Zero()), py::arg("spin") = 0.,
           py::arg("axis") = Vec3(Vec3::UnitZ()),
           py::arg("centre") = Vec3(Vec3::Zero()), py::keep_alive<0, 1>(),
           "Adds a rigid wall of triangles, counter-clockwise seen from "
           "outside of the particles' side, that moves and turns.")
      .def(
          "set_periodic_cell",
          [](PyEngine &self, const Vec3 &centre, const Vec3 &length)
          {
            require_finite("centre", centre);
            require_finite("length", length);
            self.engine.set_periodic_cell(centre, length);
          },
          py::arg("centre"), py::arg("length"),
          "Makes the scene periodic along the axes whose length is above 0 "
          "[m].")
      .def(
          "set_cell_rate",
          [](PyEngine &self, const Vec3 &rate)
          {
            require_finite("rate", rate);
            self.engine.set_cell_rate(rate);
          },
          py::arg("rate"), "Rates of the lengths of the cell [m/s].");
  bind_columns(engine);
  bind_steps(engine);
}
