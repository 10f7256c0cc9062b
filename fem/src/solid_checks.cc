#include "solid_state.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace fem
{
namespace
{
void require(bool condition, const std::string &what, double value,
             const std::string &allowed)
{
  if (!condition)
    throw std::invalid_argument("solid: " + what + " = " +
                                std::to_string(value) + ", " + allowed);
}

void check_layer(const SolidLayer &layer)
{
  require(std::isfinite(layer.youngs_modulus) && layer.youngs_modulus > 0.,
          "youngs_modulus", layer.youngs_modulus, "must be positive");
  require(layer.poisson_ratio > -1. && layer.poisson_ratio < 0.5,
          "poisson_ratio", layer.poisson_ratio,
          "must be above -1 and below 0.5");
  require(std::isfinite(layer.density) && layer.density > 0., "density",
          layer.density, "must be positive");
  if (!layer.yields())
    return;
  require(layer.law == SolidLaw::linear, "cohesion", layer.cohesion,
          "must be infinite in a neo-Hookean layer");
  require(layer.friction_angle >= 0. && layer.friction_angle < 0.5 * M_PI,
          "friction_angle", layer.friction_angle,
          "must be from 0 to below pi / 2");
  require(layer.dilatancy_angle >= 0. &&
              layer.dilatancy_angle <= layer.friction_angle,
          "dilatancy_angle", layer.dilatancy_angle,
          "must be from 0 to friction_angle");
  require(layer.cohesion > 0. ||
              (layer.cohesion == 0. && layer.friction_angle > 0.),
          "cohesion", layer.cohesion,
          "must be positive, or zero with a friction_angle above zero");
}

void check_mesh(const SolidMesh &mesh, std::size_t n_layers)
{
  require(!mesh.cells.empty(), "number of cells", 0., "must be positive");
  require(mesh.layer.size() == mesh.cells.size(), "number of layer entries",
          static_cast<double>(mesh.layer.size()),
          "must be one per cell, " + std::to_string(mesh.cells.size()));
  for (const std::int32_t layer : mesh.layer)
    require(layer >= 0 && static_cast<std::size_t>(layer) < n_layers,
            "layer of a cell", layer,
            "must be below " + std::to_string(n_layers) +
                ", the number of materials");
  for (const auto &cell : mesh.cells)
    for (const std::int32_t node : cell)
      require(node >= 0 && static_cast<std::size_t>(node) < mesh.nodes.size(),
              "node of a cell", node,
              "must be below " + std::to_string(mesh.nodes.size()));
  for (const Eigen::Vector3d &node : mesh.nodes)
    require(node.allFinite(), "coordinate of a node", node.sum(),
            "must be finite");
}
} // namespace

void check_solid(const SolidParameters &parameters, const SolidMesh &mesh)
{
  for (const SolidLayer &layer : parameters.layers)
    check_layer(layer);
  require(std::isfinite(parameters.mass_damping) &&
              parameters.mass_damping >= 0.,
          "mass_damping", parameters.mass_damping, "must not be negative");
  require(std::isfinite(parameters.stiffness_damping) &&
              parameters.stiffness_damping >= 0.,
          "stiffness_damping", parameters.stiffness_damping,
          "must not be negative");
  require(parameters.solver_tolerance > 0. && parameters.solver_tolerance < 1.,
          "solver_tolerance", parameters.solver_tolerance,
          "must be between 0 and 1");
  check_mesh(mesh, parameters.layers.size());
}

void check_solid_step(double time_step)
{
  require(std::isfinite(time_step) && time_step > 0., "time step", time_step,
          "must be positive");
}

void check_solid_loads(std::size_t n_given, std::size_t n_nodes)
{
  require(n_given == n_nodes, "number of loads", static_cast<double>(n_given),
          "must be one per node, " + std::to_string(n_nodes));
}
} // namespace fem
