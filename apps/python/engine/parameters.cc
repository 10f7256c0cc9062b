// Input of the engine: the structs of dem/parameters, field by field, shapes of
// particles, and the ranges of all values.
#include "bindings.h"

#include <dem/contact/law_table.h>
#include <dem/shape/particle_shape.h>

#include <cmath>
#include <limits>
#include <pybind11/eigen.h>
#include <pybind11/stl.h>
#include <sstream>
#include <stdexcept>

namespace py = pybind11;

namespace
{
/// Finite values that a number may have: those of the cases of the program.
struct Range
{
  double lower = 0., upper = std::numeric_limits<double>::infinity();
  bool is_lower_open = false, is_upper_open = false;

  bool contains(double value) const
  {
    return std::isfinite(value) &&
           (is_lower_open ? value > lower : value >= lower) &&
           (is_upper_open ? value < upper : value <= upper);
  }
};

Range between(double lower, double upper)
{
  return {lower, upper, false, false};
}
Range above(double lower, double upper)
{
  return {lower, upper, true, false};
}
Range below(double lower, double upper)
{
  return {lower, upper, false, true};
}

std::ostream &operator<<(std::ostream &out, const Range &range)
{
  out << (range.is_lower_open ? "above " : "of at least ") << range.lower;
  if (std::isfinite(range.upper))
    out << (range.is_upper_open ? " and below " : " and at most ")
        << range.upper;
  return out;
}

void require(const std::string &name, double value, const Range &range,
             std::string_view unit)
{
  if (range.contains(value))
    return;
  std::ostringstream message;
  message << name << " = " << value << ": must be a finite number " << range;
  if (unit != "-")
    message << " " << unit;
  throw std::invalid_argument(message.str());
}

/// What contacts of particles and of walls have in common.
template <class Material>
void check_coefficients(const std::string &of, const Material &material)
{
  require(of + ".friction", material.friction, between(0., 10.), "-");
  require(of + ".rolling_friction", material.rolling_friction, between(0., 10.),
          "-");
  require(of + ".normal_damping", material.normal_damping, between(0., 5.),
          "-");
  require(of + ".shear_damping", material.shear_damping, between(0., 5.), "-");
}

void check_law(const std::string &of, const dem::LawChoice &law)
{
  std::size_t k = 0;
  for (const dem::LawParameter &parameter : law.entry().parameters)
  {
    require(of + ".law_values[" + std::to_string(k) + "], " +
                std::string(parameter.key) + " of the law " + law.entry().name,
            law.values.at(k), between(parameter.lowest, parameter.highest),
            parameter.unit);
    ++k;
  }
}

void check_particle(const dem::ParticleMaterial &particle)
{
  require("particle.density", particle.density, above(0., 3e4), "kg/m^3");
  require("particle.shear_modulus", particle.shear_modulus, between(1., 1e13),
          "Pa");
  require("particle.poisson_ratio", particle.poisson_ratio, below(0., 0.5),
          "-");
  check_coefficients("particle", particle);
  check_law("particle", dem::law_of(particle));
}

void check_wall(const std::string &of, const dem::WallMaterial &wall)
{
  require(of + ".normal_stiffness", wall.normal_stiffness, above(0., 1e15),
          "N/m");
  require(of + ".shear_stiffness", wall.shear_stiffness, between(0., 1e15),
          "N/m");
  check_coefficients(of, wall);
  if (wall.law != "linear") // which has the two stiffnesses instead
    check_law(of, dem::law_of(wall));
}

void check_breakage(const dem::BreakageParameters &breakage)
{
  require("breakage.fracture_energy", breakage.fracture_energy, above(0., 1e12),
          "J/m^2");
  require("breakage.min_equivalent_radius", breakage.min_equivalent_radius,
          between(0., 10.), "m");
  require("breakage.min_diameter", breakage.min_diameter, between(0., 10.),
          "m");
  require("breakage.hysteresis", breakage.hysteresis, below(0., 1.), "-");
}

/// Key, unit and default of each value of a law, in the order of law_values.
py::list law_parameters(const std::string &name)
{
  const auto number = static_cast<std::size_t>(dem::contact_law_number(name));
  py::list all;
  for (const dem::LawParameter &one : dem::contact_laws()[number].parameters)
    all.append(py::make_tuple(one.key, one.unit, one.value));
  return all;
}

/// Chooses a law by its name, with the defaults of its values. Throws
/// std::invalid_argument on a name that is none.
template <class Material>
void set_law(Material &material, const std::string &name)
{
  const auto number = static_cast<std::size_t>(dem::contact_law_number(name));
  material.law = name;
  material.law_values = dem::default_law_values()[number];
}

constexpr const char *about_law =
    "Name of the contact law. Setting it sets law_values to the defaults of "
    "the law, which law_parameters(name) lists.";
constexpr const char *about_law_values =
    "Values of the law in the order of law_parameters(law); those beyond its "
    "list are not read. They are read back as a copy: set the whole list.";

void bind_geometry(py::module_ &module)
{
  py::enum_<dem::ContactGeometry>(module, "ContactGeometry",
                                  "How the overlap of particles is found.")
      .value("sphere", dem::ContactGeometry::sphere,
             "Overlap of the equivalent spheres.")
      .value("radial", dem::ContactGeometry::radial,
             "Overlap of the local radii along the branch vector.")
      .value("surface", dem::ContactGeometry::surface,
             "True surfaces at their common normals.");
  using Geometry = dem::GeometryParameters;
  py::class_<Geometry>(module, "GeometryParameters",
                       "How contacts are found and renewed.")
      .def_readwrite("geometry", &Geometry::geometry,
                     "Geometry of contacts between particles.")
      .def_readwrite("wall_geometry", &Geometry::wall_geometry,
                     "Geometry of contacts with walls.")
      .def_readwrite("refresh_tolerance", &Geometry::refresh_tolerance,
                     "Angle after which an expansion is renewed [rad].")
      .def_readwrite("skin", &Geometry::skin,
                     "Skin of the lists [m]; 0: chosen by the engine.")
      .def_readwrite("usual_skin", &Geometry::usual_skin,
                     "Skin of the right order for the particles [m].");
}

void bind_materials(py::module_ &module)
{
  using Particle = dem::ParticleMaterial;
  py::class_<Particle>(module, "ParticleMaterial",
                       "Material of particles and of their contacts.")
      .def_readwrite("density", &Particle::density, "Density [kg/m^3].")
      .def_readwrite("shear_modulus", &Particle::shear_modulus,
                     "Shear modulus [Pa].")
      .def_readwrite("poisson_ratio", &Particle::poisson_ratio,
                     "Poisson's ratio [-].")
      .def_readwrite("friction", &Particle::friction,
                     "Friction coefficient [-].")
      .def_readwrite("rolling_friction", &Particle::rolling_friction,
                     "Rolling friction coefficient [-].")
      .def_readwrite("normal_damping", &Particle::normal_damping,
                     "Share of critical damping along the normal [-].")
      .def_readwrite("shear_damping", &Particle::shear_damping,
                     "Share of critical damping in shear [-].")
      .def_property(
          "law", [](const Particle &material) { return material.law; },
          &set_law<Particle>, about_law)
      .def_readwrite("law_values", &Particle::law_values, about_law_values);
  using Wall = dem::WallMaterial;
  py::class_<Wall>(module, "WallMaterial", "Contacts of particles with walls.")
      .def_property(
          "law", [](const Wall &material) { return material.law; },
          &set_law<Wall>, about_law)
      .def_readwrite("normal_stiffness", &Wall::normal_stiffness,
                     "Normal stiffness of the law linear [N/m].")
      .def_readwrite("shear_stiffness", &Wall::shear_stiffness,
                     "Shear stiffness of the law linear [N/m].")
      .def_readwrite("friction", &Wall::friction, "Friction coefficient [-].")
      .def_readwrite("rolling_friction", &Wall::rolling_friction,
                     "Rolling friction coefficient [-].")
      .def_readwrite("normal_damping", &Wall::normal_damping,
                     "Share of critical damping along the normal [-].")
      .def_readwrite("shear_damping", &Wall::shear_damping,
                     "Share of critical damping in shear [-].")
      .def_readwrite("law_values", &Wall::law_values, about_law_values);
  module.def("law_parameters", &law_parameters, py::arg("name"),
             "Values of a contact law: (key, unit, default) of each, in the "
             "order of law_values. Walls with the law linear have "
             "normal_stiffness and shear_stiffness of WallMaterial instead.");
}

void bind_breakage(py::module_ &module)
{
  using Breakage = dem::BreakageParameters;
  py::class_<Breakage>(module, "BreakageParameters",
                       "Energy criterion of particle breakage.")
      .def_readwrite("is_active", &Breakage::is_active,
                     "Whether particles may break.")
      .def_readwrite("fracture_energy", &Breakage::fracture_energy,
                     "Breakage energy per area G_c [J/m^2].")
      .def_readwrite("min_equivalent_radius", &Breakage::min_equivalent_radius,
                     "No particle breaks below this radius [m].")
      .def_readwrite("min_diameter", &Breakage::min_diameter,
                     "Particles break from this initial diameter on [m].")
      .def_readwrite("hysteresis", &Breakage::hysteresis,
                     "Cycles of the energy below this share of it do not "
                     "count [-].");
}

dem::ParticleShape shape_from(const std::vector<double> &coefficients)
{
  for (std::size_t k = 0; k < coefficients.size(); ++k)
    if (!std::isfinite(coefficients[k]))
      throw std::invalid_argument("coefficients[" + std::to_string(k) +
                                  "] = " + std::to_string(coefficients[k]) +
                                  ": must be a finite number");
  if (!coefficients.empty() && !(coefficients[0] > 0.))
    throw std::invalid_argument("coefficients: the first one, of the mean "
                                "radius, must be above 0 m");
  dem::ParticleShape shape = dem::shape_of(coefficients);
  if (!(shape.inscribed_radius > 0.))
    throw std::invalid_argument("coefficients: the radius of the surface must "
                                "be above 0 m in every direction");
  return shape;
}

dem::ParticleShape sphere(double radius)
{
  require_length("radius", radius);
  return dem::make_sphere(radius);
}

void bind_shapes(py::module_ &module)
{
  using Shape = dem::ParticleShape;
  py::class_<Shape>(module, "Shape",
                    "A particle shape: coefficients of real spherical "
                    "harmonics, degree by degree [m].")
      .def(py::init(&shape_from), py::arg("coefficients"))
      .def(
          "resized",
          [](const Shape &self, double radius)
          {
            require_length("radius", radius);
            return dem::resized(self, radius);
          },
          py::arg("radius"),
          "The same shape with another equivalent radius [m].")
      .def_static("sphere", &sphere, py::arg("radius"), "A sphere [m].")
      .def_property_readonly("radius", &dem::mean_radius,
                             "Equivalent radius [m].")
      .def_readonly("volume", &Shape::volume, "Volume [m^3].")
      .def_readonly("circumscribed_radius", &Shape::circumscribed_radius,
                    "Radius of the circumscribed sphere [m].");
}
} // namespace

/// Throws std::invalid_argument with name, value and what is allowed.
void check_parameters(const dem::EngineParameters &parameters)
{
  check_particle(parameters.particle);
  check_wall("wall", parameters.wall);
  check_wall("surface", parameters.surface);
  check_breakage(parameters.breakage);
  const dem::GeometryParameters &geometry = parameters.geometry;
  require("geometry.refresh_tolerance", geometry.refresh_tolerance,
          between(0., 0.1), "rad");
  require("geometry.skin", geometry.skin, between(0., 1.), "m");
  require("geometry.usual_skin", geometry.usual_skin, {.is_lower_open = true},
          "m");
  require_finite("gravity", parameters.gravity);
  require("local_damping", parameters.local_damping, below(0., 1.), "-");
  require("density_scaling_diameter", parameters.density_scaling_diameter, {},
          "m");
}

/// Throws std::invalid_argument unless all three components are finite.
void require_finite(const std::string &name, const dem::Vec3 &value)
{
  if (value.allFinite())
    return;
  std::ostringstream message;
  message << name << " = " << value.x() << ", " << value.y() << ", "
          << value.z() << ": must be three finite numbers";
  throw std::invalid_argument(message.str());
}

/// Throws std::invalid_argument unless the length is above 0 and finite.
void require_length(const std::string &name, double value)
{
  require(name, value, {.is_lower_open = true}, "m");
}

void bind_parameters(py::module_ &module)
{
  bind_geometry(module);
  bind_materials(module);
  bind_breakage(module);
  bind_shapes(module);
  using All = dem::EngineParameters;
  py::class_<All>(module, "Parameters", "Input of an engine.")
      .def(py::init<>(), "The defaults of the library.")
      .def_readwrite("particle", &All::particle)
      .def_readwrite("wall", &All::wall, "Particles on planes.")
      .def_readwrite("surface", &All::surface, "Particles on mesh walls.")
      .def_readwrite("geometry", &All::geometry)
      .def_readwrite("breakage", &All::breakage)
      .def_readwrite("gravity", &All::gravity, "Gravity [m/s^2].")
      .def_readwrite("local_damping", &All::local_damping,
                     "Local damping D_a [-].")
      .def_readwrite("density_scaling_diameter", &All::density_scaling_diameter,
                     "Smaller particles are accelerated as if they had this "
                     "diameter [m]; 0: none.");
}
