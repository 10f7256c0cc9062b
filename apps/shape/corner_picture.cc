#include "shape/corner_picture.h"

#include "report/text.h"

#include <dem/shape/quadrature.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <vector>

namespace spall
{
namespace
{
using dem::Vec3;
using Colour = std::array<double, 3>; ///< red, green, blue, 0 .. 255

// Sizes in px of the view box.
constexpr double panel = 260., gap = 20., head = 24., key_height = 44.;
constexpr int n_rings = 40;

/// What is drawn at a node of the sphere, of mesh and series.
struct Node
{
  std::array<Vec3, 2> point{};       ///< of the surfaces [m]
  std::array<double, 2> curvature{}; ///< kappa_max r_ins [-]
  std::array<bool, 2> is_corner{};
};

/// Means of the three nearest points of the mesh, by their distances; corners
/// are those of the nearest.
Node node_at(const Vec3 &direction, const dem::CornerComparison &compared)
{
  std::array<std::pair<double, const dem::ComparedPoint *>, 3> nearest;
  nearest.fill({4., &compared.points[0]});
  for (const dem::ComparedPoint &point : compared.points)
  {
    const double square = (point.direction - direction).squaredNorm();
    if (square >= nearest.back().first)
      continue;
    nearest.back() = {square, &point};
    std::ranges::sort(nearest, {}, [](const auto &one) { return one.first; });
  }
  Node node;
  double total = 0.;
  std::array<double, 2> radius{};
  for (const auto &[square, point] : nearest)
  {
    const double weight = 1. / (square + 1e-8);
    total += weight;
    radius[0] += weight * point->radius_mesh;
    radius[1] += weight * point->radius_series;
    node.curvature[0] +=
        weight * point->curvature_mesh * compared.inscribed_mesh;
    node.curvature[1] +=
        weight * point->curvature_series * compared.inscribed_series;
  }
  for (std::size_t which = 0; which < 2; ++which)
  {
    node.point[which] = radius[which] / total * direction;
    node.curvature[which] /= total;
  }
  node.is_corner = {nearest[0].second->is_mesh_corner,
                    nearest[0].second->is_series_corner};
  return node;
}

/// Nodes ring by ring, then both poles.
std::vector<Node> nodes_of(const dem::CornerComparison &compared)
{
  std::vector<Node> nodes;
  for (const Vec3 &direction : dem::sphere_rule(n_rings).direction)
    nodes.push_back(node_at(direction, compared));
  for (const double z : {-1., 1.})
    nodes.push_back(node_at(z * Vec3::UnitZ(), compared));
  return nodes;
}

using Cell = std::vector<std::size_t>; ///< node numbers

std::vector<Cell> cells_of_sphere()
{
  const auto n = static_cast<std::size_t>(2 * n_rings);
  const std::size_t last = n * (n_rings - 1), south = n * n_rings;
  std::vector<Cell> cells;
  for (std::size_t k = 0; k < n; ++k)
  {
    const std::size_t next = (k + 1) % n;
    for (std::size_t ring = 0; ring < last; ring += n)
      cells.push_back({ring + k, ring + next, ring + n + next, ring + n + k});
    cells.push_back({k, next, south});
    cells.push_back({last + k, last + next, south + 1});
  }
  return cells;
}

/// Dark blue, green, yellow for shares 0, 1/2, 1 (a part of viridis).
Colour scale_colour(double share)
{
  constexpr std::array<Colour, 5> stops = {Colour{68, 1, 84},
                                           {59, 82, 139},
                                           {33, 145, 140},
                                           {94, 201, 98},
                                           {253, 231, 37}};
  const double at = std::clamp(share, 0., 1.) * (stops.size() - 1);
  const auto k =
      std::min(static_cast<std::size_t>(at), std::size_t{stops.size() - 2});
  Colour colour;
  for (std::size_t c = 0; c < 3; ++c)
    colour[c] =
        std::lerp(stops[k][c], stops[k + 1][c], at - static_cast<double>(k));
  return colour;
}

std::string text_of(const Colour &colour)
{
  char text[16];
  std::snprintf(text, sizeof text, "#%02x%02x%02x",
                static_cast<unsigned>(std::lround(colour[0])),
                static_cast<unsigned>(std::lround(colour[1])),
                static_cast<unsigned>(std::lround(colour[2])));
  return text;
}

std::string label(double x, double y, const std::string &text,
                  const std::string &more = "")
{
  char start[64];
  std::snprintf(start, sizeof start, "<text x=\"%.1f\" y=\"%.1f\" ", x, y);
  return start + more + ">" + escape(text) + "</text>\n";
}

/// An orthographic view.
class View
{
public:
  explicit View(double reach) : scale(0.48 * panel / reach)
  {
    towards = Vec3(1., 1., 0.8).normalized();
    right = Vec3::UnitZ().cross(towards).normalized();
    up = towards.cross(right);
  }

  double x(const Vec3 &point) const { return scale * point.dot(right); }
  double y(const Vec3 &point) const { return -scale * point.dot(up); }
  double depth(const Vec3 &point) const { return point.dot(towards); }

private:
  Vec3 towards, right, up;
  double scale; ///< [px/m]
};

/// A cell as it is seen.
struct SeenCell
{
  double depth = 0.; ///< the larger the nearer [m]
  double light = 0.; ///< cosine to the eye [-]
  const Cell *nodes = nullptr;
};

std::vector<SeenCell> seen_cells(const std::vector<Cell> &cells,
                                 const std::vector<Node> &nodes,
                                 std::size_t which, const View &view)
{
  std::vector<SeenCell> seen;
  for (const Cell &cell : cells)
  {
    const Vec3 &a = nodes[cell[0]].point[which],
               &b = nodes[cell[1]].point[which],
               &c = nodes[cell[2]].point[which];
    Vec3 normal = (b - a).cross(c - a).normalized();
    if (normal.dot(a) < 0.)
      normal = -normal;
    if (view.depth(normal) <= 0.)
      continue;
    seen.push_back({view.depth(a + b + c) / 3., view.depth(normal), &cell});
  }
  std::ranges::sort(seen, {}, &SeenCell::depth);
  return seen;
}

std::string polygon(const SeenCell &cell, const std::vector<Node> &nodes,
                    std::size_t which, const View &view, const Colour &colour)
{
  std::string points;
  for (const std::size_t k : *cell.nodes)
  {
    char text[40];
    std::snprintf(text, sizeof text, "%s%.1f %.1f", points.empty() ? "M" : "L",
                  view.x(nodes[k].point[which]), view.y(nodes[k].point[which]));
    points += text;
  }
  const std::string fill = text_of(colour);
  return "<path d=\"" + points + "Z\" fill=\"" + fill + "\" stroke=\"" + fill +
         "\"/>\n";
}

/// Largest value of the colours: 98 % of the nodes are below [-].
double top_of(const std::vector<Node> &nodes)
{
  std::vector<double> values;
  for (const Node &node : nodes)
    for (const double value : node.curvature)
      values.push_back(value);
  const auto k = static_cast<std::ptrdiff_t>(0.98 * double(values.size()));
  std::ranges::nth_element(values, values.begin() + k);
  return std::max(1., values[std::size_t(k)]);
}

double mean_of(const Cell &cell, const std::vector<Node> &nodes,
               std::size_t which)
{
  double sum = 0.;
  for (const std::size_t k : cell)
    sum += nodes[k].curvature[which] / double(cell.size());
  return sum;
}

Colour corner_colour(const SeenCell &cell, const std::vector<Node> &nodes,
                     std::size_t which)
{
  constexpr Colour corner = {213, 94, 0}, flat = {216, 211, 202};
  std::size_t n_corners = 0;
  for (const std::size_t k : *cell.nodes)
    n_corners += nodes[k].is_corner[which] ? 1 : 0;
  Colour colour = 2 * n_corners > cell.nodes->size() ? corner : flat;
  for (double &one : colour)
    one *= 0.55 + 0.45 * cell.light;
  return colour;
}

/// A bar of the colours from 0 to the top.
std::string colour_key(double y, double top)
{
  std::string out;
  constexpr int n = 52;
  for (int k = 0; k < n; ++k)
  {
    char text[120];
    std::snprintf(text, sizeof text,
                  "<rect x=\"%.1f\" y=\"%.1f\" width=\"5.5\" height=\"10\" "
                  "fill=\"%s\"/>\n",
                  gap + 5. * k, y,
                  text_of(scale_colour((k + 0.5) / n)).c_str());
    out += text;
  }
  const double end = gap + 5. * n;
  return out + label(gap, y + 24., "0") +
         label(end, y + 24., format(top, 2), "text-anchor=\"end\"") +
         label(end + gap, y + 10., "κmax · r_ins; a corner has more than 1");
}
} // namespace

std::string corner_picture(const dem::CornerComparison &compared)
{
  const std::vector<Node> nodes = nodes_of(compared);
  const std::vector<Cell> cells = cells_of_sphere();
  const double top = top_of(nodes);
  double reach = 0.;
  for (const dem::ComparedPoint &point : compared.points)
    reach = std::max(reach, point.radius_mesh);
  const View view(reach);
  const double width = 2. * panel + 3. * gap,
               height = head + 2. * panel + key_height;
  char box[200];
  std::snprintf(box, sizeof box,
                "<svg viewBox=\"0 0 %.0f %.0f\" role=\"img\" aria-label=\"",
                width, height);
  std::string out =
      box +
      escape("Largest curvature (above) and corners and edges (below) of a "
             "mesh (left) and of its series (right).") +
      "\" font-family=\"Helvetica, Arial, 'Liberation Sans', sans-serif\" "
      "font-size=\"12\" fill=\"#222\" stroke-width=\"0.4\">\n";
  for (std::size_t which = 0; which < 2; ++which)
  {
    const double x = gap + (panel + gap) * double(which);
    out +=
        label(x, 16., which == 0 ? "Mesh" : "Series", "font-weight=\"bold\"");
    const std::vector<SeenCell> seen = seen_cells(cells, nodes, which, view);
    for (int row = 0; row < 2; ++row)
    {
      char start[80];
      std::snprintf(start, sizeof start,
                    "<g transform=\"translate(%.1f %.1f)\">\n", x + 0.5 * panel,
                    head + (row + 0.5) * panel);
      out += start;
      for (const SeenCell &cell : seen)
        out += polygon(
            cell, nodes, which, view,
            row == 0 ? scale_colour(mean_of(*cell.nodes, nodes, which) / top)
                     : corner_colour(cell, nodes, which));
      out += "</g>\n";
    }
  }
  return out + colour_key(head + 2. * panel + 6., top) + "</svg>\n";
}
} // namespace spall
