#include "subgrade/ground.h"

#include "case/gravity.h"
#include "subgrade/ground_file.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <span>

namespace spall
{
namespace
{
/// Widths from the middle outward, mirrored: equal cells to `half`, then
/// growing ones to the edge.
std::vector<double> widths_across(const GroundParameters &g, double half,
                                  double length)
{
  const int n = std::max(
      1, static_cast<int>(std::ceil(half / g.cell_size * (1. - 1e-9))));
  std::vector<double> outward(static_cast<std::size_t>(n), half / n);
  if (const double rest = 0.5 * length - half; rest > 1e-9 * length)
    for (const double width :
         fem::graded_widths(std::min(half / n, rest), g.growth, rest))
      outward.push_back(width);
  std::vector<double> all(outward.rbegin(), outward.rend());
  all.insert(all.end(), outward.begin(), outward.end());
  return all;
}

/// From the bottom up; layers end where cells do.
std::vector<double> heights_of(const GroundParameters &g)
{
  std::vector<double> down;
  double next = g.cell_size;
  for (const GroundLayer &layer : parse_ground_layers(g.layers))
  {
    for (const double height : fem::graded_widths(
             std::min(next, layer.thickness), g.growth, layer.thickness))
      down.push_back(height);
    next = down.back() * g.growth;
  }
  return {down.rbegin(), down.rend()};
}

fem::SolidMesh box_of_cells(const Case &c)
{
  const GroundParameters &g = c.subgrade.ground;
  const Footprint plate = footprint(c.subgrade.plate);
  fem::BoxMesh box;
  box.lower = {-0.5 * g.length, -0.5 * g.width, -depth_of(g)};
  box.widths = {widths_across(g, plate.half_x, g.length),
                widths_across(g, plate.half_y, g.width), heights_of(g)};
  fem::SolidMesh mesh = fem::box_mesh(box);
  fem::assign_layers(mesh, layer_tops(g));
  return mesh;
}

/// Of level ground at rest under its own weight; lateral share 1 - sin phi
/// (Jaky 1944) [Pa].
fem::Voigt weight_stress(std::span<const GroundLayer> layers, double depth)
{
  double vertical = 0., share = 1., top = 0.;
  for (const GroundLayer &layer : layers)
  {
    if (depth <= top)
      break;
    vertical -=
        gravity * layer.density * std::min(depth - top, layer.thickness);
    share = 1. - std::sin(layer.friction_angle * std::numbers::pi / 180.);
    top += layer.thickness;
  }
  fem::Voigt stress = fem::Voigt::Zero();
  stress.head<3>() << share * vertical, share * vertical, vertical;
  return stress;
}

fem::SolidSolver solver_of(GroundSolver solver)
{
  switch (solver)
  {
  case GroundSolver::amg:
    return fem::SolidSolver::amg;
  case GroundSolver::distributed_amg:
    return fem::SolidSolver::distributed_amg;
  case GroundSolver::direct:
    break;
  }
  return fem::SolidSolver::direct;
}

fem::SolidParameters soil_of(const GroundParameters &g,
                             std::span<const GroundLayer> layers)
{
  fem::SolidParameters soil;
  soil.layers.clear();
  for (const GroundLayer &layer : layers)
    soil.layers.push_back({layer.youngs_modulus, layer.poisson_ratio,
                           layer.density, layer.cohesion,
                           layer.friction_angle * std::numbers::pi / 180.,
                           layer.dilatancy_angle * std::numbers::pi / 180.});
  std::ranges::reverse(soil.layers); // tops ascend
  soil.mass_damping = g.mass_damping;
  soil.stiffness_damping = g.stiffness_damping;
  soil.solver = solver_of(g.solver);
  soil.solver_tolerance = g.solver_tolerance;
  return soil;
}

bool has_boundary(const fem::SolidMesh &mesh, std::int32_t side)
{
  return std::ranges::any_of(mesh.faces,
                             [side](const fem::SolidMesh::Face &face)
                             { return face.boundary == side; });
}

void hold(const GroundParameters &g, std::int32_t side, fem::Solid &ground)
{
  const bool is_bottom = side == fem::z_lower;
  if ((is_bottom ? g.bottom : g.sides) == GroundSide::absorbing)
  {
    ground.absorb(side);
    ground.hold_far_field(side, Eigen::Vector3d::Zero());
  }
  else
    ground.fix(side, {is_bottom || side <= fem::x_upper,
                      is_bottom || side >= fem::y_lower, is_bottom});
}
} // namespace

fem::SolidMesh ground_mesh(const Case &c)
{
  return c.subgrade.ground.mesh.empty() ? box_of_cells(c) : read_ground(c);
}

fem::Solid make_ground(const Case &c)
{
  const GroundParameters &g = c.subgrade.ground;
  const std::vector<GroundLayer> layers = parse_ground_layers(g.layers);
  fem::Solid ground(soil_of(g, layers), ground_mesh(c));
  ground.set_initial_stress([&](const Eigen::Vector3d &position)
                            { return weight_stress(layers, -position.z()); });
  constexpr std::array<std::int32_t, 6> sides = {fem::z_lower, fem::x_lower,
                                                 fem::x_upper, fem::y_lower,
                                                 fem::y_upper, slanted_side};
  for (const std::int32_t side : sides)
    if (has_boundary(ground.mesh(), side))
      hold(g, side, ground);
  return ground;
}
} // namespace spall
