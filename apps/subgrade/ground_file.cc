#include "subgrade/ground_file.h"

#include "case/digits.h"
#include "case/file.h"
#include "errors.h"
#include "subgrade/layer_room.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <set>
#include <stdexcept>
#include <utility>

namespace spall
{
namespace
{
using Vector = Eigen::Vector3d;

/// How far nodes of the top may lie off its plane, and its middle node off the
/// middle [m].
constexpr double flat = 1e-6, central = 1e-9;
/// Component of a normal at 45 degrees to the vertical [-].
constexpr double slope = 0.5 * std::numbers::sqrt2;

[[noreturn]] void refuse(const Case &c, const std::string &what)
{
  throw InputError(c.file + ": Subgrade/mesh = " + c.subgrade.ground.mesh +
                   ": " + what);
}

/// A face of the surface with the data that its position is checked by.
struct Side
{
  std::array<Vector, 4> corners;
  Vector centre = Vector::Zero(), normal; ///< [m], unit, outward

  Side(const fem::SolidMesh &mesh, const fem::SolidMesh::Face &face)
  {
    for (std::size_t v = 0; v < 4; ++v)
    {
      corners[v] = mesh.nodes[static_cast<std::size_t>(face.corners[v])];
      centre += 0.25 * corners[v];
    }
    normal =
        (corners[2] - corners[0]).cross(corners[3] - corners[1]).normalized();
  }
  bool is_top() const
  {
    return std::ranges::all_of(corners, [](const Vector &corner)
                               { return std::abs(corner.z()) <= flat; });
  }
  bool faces_away() const
  {
    return std::ranges::all_of(corners, [this](const Vector &corner)
                               { return corner.dot(normal) > 0.; });
  }
};

/// Which part of the surface, by the normal of the face.
std::int32_t boundary_of(const Vector &normal)
{
  constexpr double straight = 1. - 1e-6;
  if (normal.z() < -slope)
    return fem::z_lower;
  if (std::abs(normal.x()) > straight)
    return normal.x() < 0. ? fem::x_lower : fem::x_upper;
  if (std::abs(normal.y()) > straight)
    return normal.y() < 0. ? fem::y_lower : fem::y_upper;
  return slanted_side;
}

void name_boundaries(const Case &c, fem::SolidMesh &mesh)
{
  for (fem::SolidMesh::Face &face : mesh.faces)
  {
    const Side side(mesh, face);
    if (side.is_top())
    {
      face.boundary = fem::z_upper;
      continue;
    }
    if (side.normal.z() > slope)
      refuse(c, "a face at " + in_four_digits(side.centre) +
                    " m looks up: only the top at z = 0 may, and cells that "
                    "meet must share their nodes");
    if (!side.faces_away())
      refuse(c, "a face at " + in_four_digits(side.centre) +
                    " m does not face away from the middle of the top: the "
                    "whole block must be seen from there, and cells that meet "
                    "must share their nodes");
    face.boundary = boundary_of(side.normal);
  }
}

/// By physical volumes if there are several, else by depth.
void name_layers(const Case &c, fem::SolidMesh &mesh)
{
  const std::vector<GroundLayer> layers =
      parse_ground_layers(c.subgrade.ground.layers);
  const auto n = static_cast<std::int32_t>(layers.size());
  const std::set<std::int32_t> volumes(mesh.layer.begin(), mesh.layer.end());
  if (volumes.size() > 1)
  {
    if (*volumes.begin() != 1 || *volumes.rbegin() != n ||
        static_cast<std::int32_t>(volumes.size()) != n)
      refuse(c, "has " + std::to_string(volumes.size()) +
                    " physical volumes with numbers from " +
                    std::to_string(*volumes.begin()) + " to " +
                    std::to_string(*volumes.rbegin()) + ": must be 1 to " +
                    std::to_string(n) +
                    ", one for each layer of Subgrade/layers, or one in all");
    for (std::int32_t &layer : mesh.layer)
      layer = n - layer;
    return;
  }
  fem::assign_layers(mesh, layer_tops(c.subgrade.ground));
  for (std::int32_t k = 0; k < n; ++k)
    if (std::ranges::find(mesh.layer, n - 1 - k) == mesh.layer.end())
      refuse(c, "no cell has its centre in layer " + std::to_string(k + 1) +
                    " of Subgrade/layers: cells must be flatter, or the layer "
                    "thicker");
}

void check_extent(const Case &c, const fem::SolidMesh &mesh)
{
  const auto height = [](const Vector &node) { return node.z(); };
  const double highest = std::ranges::max(mesh.nodes, {}, height).z();
  const double depth = -std::ranges::min(mesh.nodes, {}, height).z();
  if (std::abs(highest) > flat)
    refuse(c, "its highest node is at z = " + in_four_digits(highest) +
                  " m: must be at 0");
  const double layers = depth_of(c.subgrade.ground);
  if (std::abs(depth - layers) > 1e-6 * layers)
    refuse(c, "it is " + in_four_digits(depth) +
                  " m deep: must be as deep as Subgrade/layers in all, " +
                  in_four_digits(layers) + " m (files are in metres)");
  if (std::ranges::none_of(mesh.nodes, [](const Vector &node)
                           { return node.norm() < central; }))
    refuse(c, "no node at (0, 0, 0): there must be one below the middle of the "
              "plate");
}

/// Area of the part of a polygon in a convex quad at z = 0, cut side by side
/// (Sutherland and Hodgman 1974) [m^2].
double area_inside(const Side &quad, dem::Polygon rim)
{
  dem::Polygon window;
  for (const Vector &corner : quad.corners)
    window.emplace_back(corner.head<2>());
  if (dem::polygon_area(window) < 0.)
    std::ranges::reverse(window);
  for (std::size_t side = 0; side < window.size(); ++side)
  {
    const Eigen::Vector2d &start = window[side],
                          along = window[(side + 1) % window.size()] - start;
    const auto inside = [&](const Eigen::Vector2d &point)
    {
      const Eigen::Vector2d from = point - start;
      return along.x() * from.y() - along.y() * from.x();
    };
    dem::Polygon kept;
    for (std::size_t k = 0; k < rim.size(); ++k)
    {
      const Eigen::Vector2d &from = rim[k], &to = rim[(k + 1) % rim.size()];
      const double before = inside(from), after = inside(to);
      if (before >= 0.)
        kept.push_back(from);
      if (before * after < 0.)
        kept.push_back(from + before / (before - after) * (to - from));
    }
    rim = std::move(kept);
  }
  return std::abs(dem::polygon_area(rim));
}

double longest_edge(const Side &quad)
{
  double longest = 0.;
  for (std::size_t v = 0; v < 4; ++v)
    longest =
        std::max(longest, (quad.corners[(v + 1) % 4] - quad.corners[v]).norm());
  return longest;
}

/// It lies under all particles, and is fine enough under the plate.
void check_top(const Case &c, const fem::SolidMesh &mesh)
{
  const dem::Polygon foot = foot_of(layer_room(c));
  const Footprint plate = footprint(c.subgrade.plate);
  const double x = plate.half_x, y = plate.half_y;
  const double narrow = 2. * std::min(plate.half_x, plate.half_y);
  double covered = 0., coarsest = 0.;
  for (const fem::SolidMesh::Face &face : mesh.faces)
  {
    if (face.boundary != fem::z_upper)
      continue;
    const Side quad(mesh, face);
    covered += area_inside(quad, foot);
    if (area_inside(quad, {{-x, -y}, {x, -y}, {x, y}, {-x, y}}) > 1e-9 * x * y)
      coarsest = std::max(coarsest, longest_edge(quad));
  }
  if (const double asked = dem::polygon_area(foot);
      covered < (1. - 1e-6) * asked)
    refuse(c, "its top lies under " + in_four_digits(covered) +
                  " m^2 of the box of the particles: must be all of " +
                  (c.container.has_mesh() ? "the foot of Container/mesh, "
                                          : "Layer/length times width, ") +
                  in_four_digits(asked) + " m^2");
  if (coarsest > narrow)
    refuse(c, "an edge of its top under the plate is " +
                  in_four_digits(coarsest) +
                  " m long: must be at most the narrow side of the plate, " +
                  in_four_digits(narrow) + " m");
}

void check_sides(const Case &c, const fem::SolidMesh &mesh)
{
  if (c.subgrade.ground.sides == GroundSide::rigid &&
      std::ranges::any_of(mesh.faces, [](const fem::SolidMesh::Face &face)
                          { return face.boundary == slanted_side; }))
    throw InputError(c.file +
                     ": Subgrade/sides = rigid: must be absorbing "
                     "with Subgrade/mesh = " +
                     c.subgrade.ground.mesh +
                     ", which has sides along neither x nor y");
}
} // namespace

fem::SolidMesh read_ground(const Case &c)
{
  fem::SolidMesh mesh;
  try
  {
    mesh = fem::read_solid_mesh(
        find_path(c, "Subgrade", "mesh", c.subgrade.ground.mesh));
  }
  catch (const std::invalid_argument &what)
  {
    refuse(c, what.what());
  }
  check_extent(c, mesh);
  name_boundaries(c, mesh);
  name_layers(c, mesh);
  check_top(c, mesh);
  check_sides(c, mesh);
  return mesh;
}
} // namespace spall
