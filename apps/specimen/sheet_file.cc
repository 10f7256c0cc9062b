#include "specimen/sheet_file.h"

#include "case/digits.h"
#include "case/file.h"
#include "errors.h"
#include "run/digest.h"

#include <fem/surface_file.h>

#include <algorithm>
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

/// Of nodes in a plane, over the size; and on a circle, over its radius [-].
constexpr double flat = 1e-6, round = 1e-3;

/// A sheet between the planes of its rims.
struct Sheet
{
  fem::SurfaceMesh mesh;
  Vector lower = Vector::Zero(), upper = Vector::Zero(); ///< corners [m]

  const Vector &at(std::int32_t node) const
  {
    return mesh.nodes[static_cast<std::size_t>(node)];
  }
  Vector middle_of(const std::array<std::int32_t, 4> &quad) const
  {
    return 0.25 * (at(quad[0]) + at(quad[1]) + at(quad[2]) + at(quad[3]));
  }
  bool is_at(const Vector &node, int axis, double plane) const
  {
    return std::abs(node[axis] - plane) <= flat * (upper - lower)[axis];
  }
  bool is_on_rim(const Vector &node) const
  {
    return is_at(node, 2, lower.z()) || is_at(node, 2, upper.z());
  }
};

[[noreturn]] void refuse(const Case &c, const std::string &what)
{
  throw InputError(c.file + ": Boundary/mesh = " + c.boundary.mesh + ": " +
                   what);
}

Sheet read(const Case &c)
{
  Sheet sheet;
  try
  {
    const std::string path = find_path(c, "Boundary", "mesh", c.boundary.mesh);
    if (const auto known = c.contents.find("Boundary/mesh");
        known != c.contents.end() && digest_of_file(path) != known->second)
      refuse(c, "has changed since the run began");
    sheet.mesh = fem::read_surface_mesh(path);
  }
  catch (const std::invalid_argument &what)
  {
    refuse(c, what.what());
  }
  sheet.lower = sheet.upper = sheet.mesh.nodes.at(0);
  for (const Vector &node : sheet.mesh.nodes)
  {
    sheet.lower = sheet.lower.cwiseMin(node);
    sheet.upper = sheet.upper.cwiseMax(node);
  }
  if (!((sheet.upper - sheet.lower).minCoeff() > 0.))
    refuse(c, "is flat: must be the side of an upright box or cylinder");
  return sheet;
}

/// Each quad in one of the four planes.
void check_box(const Case &c, const Sheet &sheet)
{
  for (const auto &quad : sheet.mesh.quads)
  {
    bool is_in_plane = false;
    for (int d = 0; d < 2; ++d)
      for (const double plane : {sheet.lower[d], sheet.upper[d]})
        is_in_plane |= std::ranges::all_of(
            quad, [&](std::int32_t node)
            { return sheet.is_at(sheet.at(node), d, plane); });
    if (!is_in_plane)
      refuse(c, "a quad at " + in_four_digits(sheet.middle_of(quad)) +
                    " lies in none of the four sides of an upright box, which "
                    "Specimen/form = box asks for");
  }
}

/// Angle round the z axis that a quad takes up [rad].
double span_of(const Sheet &sheet, const std::array<std::int32_t, 4> &quad)
{
  const Vector &first = sheet.at(quad[0]);
  double least = 0., most = 0.;
  for (const std::int32_t node : quad)
  {
    const Vector &other = sheet.at(node);
    const double angle =
        std::atan2(first.x() * other.y() - first.y() * other.x(),
                   first.head<2>().dot(other.head<2>()));
    least = std::min(least, angle);
    most = std::max(most, angle);
  }
  return most - least;
}

/// Radius of the largest cylinder inside [m].
double inner_radius(const Case &c, const Sheet &sheet)
{
  const auto radius_of = [](const Vector &node)
  { return node.head<2>().norm(); };
  const auto [nearest, farthest] =
      std::ranges::minmax(sheet.mesh.nodes, {}, radius_of);
  const double radius = radius_of(nearest);
  if (radius < (1. - round) * radius_of(farthest))
    refuse(c, "the node " + in_four_digits(nearest) + " is " +
                  in_four_digits(radius) + " from the z axis, others " +
                  in_four_digits(radius_of(farthest)) +
                  ": all must be on one cylinder round it, which "
                  "Specimen/form = cylinder asks for");
  double widest = 0.;
  for (const auto &quad : sheet.mesh.quads)
    widest = std::max(widest, span_of(sheet, quad));
  if (widest > std::numbers::pi / 3. * (1. + flat))
    refuse(c, "a quad goes round " +
                  in_four_digits(widest * 180. / std::numbers::pi) +
                  " degrees of the cylinder: must be at most 60");
  return radius * std::cos(0.5 * widest);
}

/// The sheet ends at its rims alone, and has nodes between them.
void check_rims(const Case &c, const Sheet &sheet)
{
  std::set<std::pair<std::int32_t, std::int32_t>> edges;
  for (const auto &quad : sheet.mesh.quads)
    for (std::size_t v = 0; v < 4; ++v)
      edges.emplace(quad[v], quad[(v + 1) % 4]);
  for (const auto &[from, to] : edges)
    if (!edges.contains({to, from}) &&
        !(sheet.is_on_rim(sheet.at(from)) && sheet.is_on_rim(sheet.at(to))))
      refuse(c, "ends at " + in_four_digits(sheet.at(from)) +
                    ": must go round and end at a lower and an upper rim, each "
                    "at one height, and quads that meet must share their "
                    "nodes");
  if (std::ranges::all_of(sheet.mesh.nodes, [&](const Vector &node)
                          { return sheet.is_on_rim(node); }))
    refuse(c, "has no nodes between its rims: must have two rows of quads");
}

/// Turns the quads outward. `section` of a sheet that goes round once, about.
void face_outward(const Case &c, double section, Sheet &sheet)
{
  double inside = 0.;
  for (const auto &quad : sheet.mesh.quads)
  {
    const Vector area = 0.5 * (sheet.at(quad[2]) - sheet.at(quad[0]))
                                  .cross(sheet.at(quad[3]) - sheet.at(quad[1]));
    inside += 0.5 * sheet.middle_of(quad).head<2>().dot(area.head<2>());
  }
  const double share = inside / (section * (sheet.upper.z() - sheet.lower.z()));
  if (std::abs(std::abs(share) - 0.95) > 0.15) // few sides: less
    refuse(c, "closes in " + in_four_digits(std::abs(share)) +
                  " of the volume between its rims: must go round once");
  if (share < 0.)
    for (auto &quad : sheet.mesh.quads)
      std::swap(quad[1], quad[3]);
}
} // namespace

fem::SurfaceMesh read_sheet(const Case &c, const dem::Vec3 &lower,
                            const dem::Vec3 &upper)
{
  Sheet sheet = read(c);
  const Vector size = sheet.upper - sheet.lower;
  const bool is_box = c.specimen.form == SpecimenForm::box;
  double scale = 0.;
  check_rims(c, sheet);
  if (is_box)
  {
    check_box(c, sheet);
    face_outward(c, size.x() * size.y(), sheet);
  }
  else
  {
    scale = 0.5 * (upper.x() - lower.x()) / inner_radius(c, sheet);
    face_outward(c, 0.25 * std::numbers::pi * size.x() * size.y(), sheet);
  }
  const Vector middle = 0.5 * (lower + upper);
  for (Vector &node : sheet.mesh.nodes)
  {
    const Vector share = (node - sheet.lower).cwiseQuotient(size);
    for (int d = 0; d < 3; ++d)
      node[d] = is_box || d == 2 ? std::lerp(lower[d], upper[d], share[d])
                                 : middle[d] + scale * node[d];
  }
  return sheet.mesh;
}
} // namespace spall
