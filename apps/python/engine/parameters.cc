// Parameters of the engine: the structs of dem/parameters, field by field.
#include "bindings.h"

#include <dem/parameters/engine.h>

#include <pybind11/eigen.h>
#include <pybind11/stl.h>

namespace py = pybind11;

namespace
{
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
      .def_readwrite("law", &Particle::law, "Name of the contact law.")
      .def_readwrite("law_values", &Particle::law_values,
                     "Parameters of the law, in its order.");
  using Wall = dem::WallMaterial;
  py::class_<Wall>(module, "WallMaterial", "Contacts of particles with walls.")
      .def_readwrite("law", &Wall::law, "Name of the contact law.")
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
      .def_readwrite("law_values", &Wall::law_values,
                     "Parameters of the law, in its order.");
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
} // namespace

void bind_parameters(py::module_ &module)
{
  bind_geometry(module);
  bind_materials(module);
  bind_breakage(module);
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
