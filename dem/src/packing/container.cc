#include <dem/packing/container.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <stdexcept>
#include <string>

namespace dem
{
namespace
{
/// Points this near to the top, over the size of the container, are at the rim;
/// cross-sections may exceed that of the rim by this share [-].
constexpr double tolerance = 1e-6;

using Edge = std::array<std::int32_t, 2>;

[[noreturn]] void refuse(const std::string &text)
{
  throw std::invalid_argument(text);
}

std::string metres(double length)
{
  std::ostringstream text;
  text << length << " m";
  return text.str();
}

double lowest_corner(const FacetSurface &surface)
{
  double lowest = std::numeric_limits<double>::infinity();
  for (const Vec3 &point : surface.position)
    lowest = std::min(lowest, point.z());
  return lowest;
}

/// Triangles that are joined by edges.
std::size_t count_pieces(const FacetSurface &surface)
{
  const FacetTopology topology(surface);
  std::vector<bool> is_seen(surface.triangles.size(), false);
  std::vector<std::size_t> waiting;
  std::size_t n_pieces = 0;
  for (std::size_t start = 0; start < is_seen.size(); ++start)
  {
    if (is_seen[start])
      continue;
    ++n_pieces;
    is_seen[start] = true;
    waiting.push_back(start);
    while (!waiting.empty())
    {
      const std::size_t t = waiting.back();
      waiting.pop_back();
      for (const std::int32_t next : topology.neighbour[t])
        if (next >= 0 && !is_seen[static_cast<std::size_t>(next)])
        {
          is_seen[static_cast<std::size_t>(next)] = true;
          waiting.push_back(static_cast<std::size_t>(next));
        }
    }
  }
  return n_pieces;
}

/// Edges of one triangle alone, each in the direction of its triangle.
std::vector<Edge> open_edges(const FacetSurface &surface)
{
  const FacetTopology topology(surface);
  std::vector<Edge> edges;
  for (std::size_t t = 0; t < surface.triangles.size(); ++t)
    for (std::size_t e = 0; e < 3; ++e)
      if (topology.neighbour[t][e] < 0)
        edges.push_back(
            {surface.triangles[t][e], surface.triangles[t][(e + 1) % 3]});
  return edges;
}

/// Closed lines that the edges are, each corner the start of one edge.
std::size_t count_loops(const std::vector<Edge> &edges)
{
  std::map<std::int32_t, std::int32_t> next;
  for (const Edge &edge : edges)
    if (!next.emplace(edge[0], edge[1]).second)
      refuse("mesh touches itself at its rim");
  std::size_t n = 0;
  while (!next.empty())
  {
    ++n;
    for (auto at = next.begin(); at != next.end();)
    {
      const std::int32_t to = at->second;
      next.erase(at);
      at = next.find(to);
    }
  }
  return n;
}

void turn_over(FacetSurface &surface)
{
  for (auto &corners : surface.triangles)
    std::swap(corners[1], corners[2]);
}

void complete(FacetSurface &surface)
{
  const std::size_t n = surface.position.size();
  surface.velocity.assign(n, Vec3::Zero());
  surface.mass.assign(n, std::numeric_limits<double>::infinity());
  surface.load.assign(n, Vec3::Zero());
}

/// Corners that no triangle has are left out.
void drop_unused(FacetSurface &surface)
{
  std::vector<std::int32_t> number(surface.position.size(), -1);
  std::vector<Vec3> used;
  for (auto &corners : surface.triangles)
    for (std::int32_t &corner : corners)
    {
      std::int32_t &its = number[static_cast<std::size_t>(corner)];
      if (its < 0)
      {
        its = static_cast<std::int32_t>(used.size());
        used.push_back(surface.position[static_cast<std::size_t>(corner)]);
      }
      corner = its;
    }
  surface.position = std::move(used);
}
} // namespace

double Container::Slope::share_below(double z) const
{
  if (z <= low)
    return 0.;
  if (z >= high)
    return 1.;
  if (z <= middle)
    return (z - low) * (z - low) / ((middle - low) * (high - low));
  return 1. - (high - z) * (high - z) / ((high - middle) * (high - low));
}

double Container::Slope::depth_below(double z) const
{
  if (z <= low)
    return 0.;
  const double whole = z - (low + middle + high) / 3.;
  if (z >= high)
    return whole;
  if (z <= middle)
    return std::pow(z - low, 3) / (3. * (middle - low) * (high - low));
  return whole + std::pow(high - z, 3) / (3. * (high - middle) * (high - low));
}

Container::Container(FacetSurface surface)
{
  if (count_pieces(surface) != 1)
    refuse("mesh has " + std::to_string(count_pieces(surface)) +
           " pieces: must be one, the inner surface of the container");
  const double lowest = lowest_corner(surface);
  for (Vec3 &point : surface.position)
    point.z() -= lowest;
  least = most = surface.position.front();
  for (const Vec3 &point : surface.position)
  {
    least = least.cwiseMin(point);
    most = most.cwiseMax(point);
  }
  height = most.z();
  if (height <= tolerance * (most - least).norm())
    refuse("mesh is flat");
  if (open_edges(surface).empty())
    take_lid_off(surface);
  const std::vector<Edge> rim = rim_of(surface);
  add_slopes(surface);
  if (volume_below(height) < 0.) // an open mesh has its normals to the inside
  {
    turn_over(surface);
    for (Slope &slope : slopes)
      slope.area = -slope.area;
  }
  require_wide_mouth();
  shell = std::move(surface);
  set_collar(height);
}

void Container::take_lid_off(FacetSurface &surface) const
{
  const double near = tolerance * (most - least).norm();
  const auto is_at_top = [&](const std::array<std::int32_t, 3> &corners)
  {
    return std::ranges::all_of(
        corners,
        [&](std::int32_t corner)
        {
          return surface.position[static_cast<std::size_t>(corner)].z() >
                 height - near;
        });
  };
  const std::size_t n_removed = std::erase_if(surface.triangles, is_at_top);
  if (n_removed == 0)
    refuse("mesh is closed without a flat lid at its top: must be open there "
           "or have one, which is taken off");
  drop_unused(surface);
  complete(surface);
}

std::vector<Edge> Container::rim_of(const FacetSurface &surface) const
{
  const double near = tolerance * (most - least).norm();
  const std::vector<Edge> edges = open_edges(surface);
  std::size_t n_below = 0;
  double lowest = height;
  for (const Edge &edge : edges)
    for (const std::int32_t corner : edge)
      if (const double z =
              surface.position[static_cast<std::size_t>(corner)].z();
          z < height - near)
      {
        ++n_below;
        lowest = std::min(lowest, z);
      }
  if (n_below > 0)
    refuse("mesh leaks: it is open below its flat rim at " + metres(height) +
           " above its lowest point, down to " + metres(lowest) +
           ": must be open at the rim alone");
  if (const std::size_t n = count_loops(edges); n != 1)
    refuse("mesh has " + std::to_string(n) +
           " open rims at its top: must have one, that of the inner surface "
           "of the container");
  return edges;
}

void Container::add_slopes(const FacetSurface &surface)
{
  for (std::size_t t = 0; t < surface.triangles.size(); ++t)
  {
    const auto corner = corners_of(surface, static_cast<std::int32_t>(t));
    std::array z{corner[0].z(), corner[1].z(), corner[2].z()};
    std::ranges::sort(z);
    const double shows_up =
        0.5 * (corner[1] - corner[0]).cross(corner[2] - corner[0]).z();
    slopes.push_back({z[0], z[1], z[2], -shows_up});
  }
}

double Container::section(double z) const
{
  double sum = 0.;
  for (const Slope &slope : slopes)
    sum += slope.area * slope.share_below(z);
  return sum;
}

double Container::volume_below(double z) const
{
  double sum = 0.;
  for (const Slope &slope : slopes)
    sum += slope.area * slope.depth_below(z);
  return sum;
}

double Container::height_of(double volume) const
{
  const double full = volume_below(height);
  if (volume >= full)
    return height + (volume - full) / section(height);
  double below = 0., above = height;
  while (true)
  {
    const double middle = 0.5 * (below + above);
    if (middle <= below || middle >= above)
      return middle;
    (volume_below(middle) < volume ? below : above) = middle;
  }
}

/// Just above corners and halfway to the next ones; where these have many
/// heights, at some of them.
void Container::require_wide_mouth() const
{
  constexpr std::size_t n_most = 200;
  std::vector<double> corners;
  for (const Slope &slope : slopes)
    corners.push_back(slope.high);
  std::ranges::sort(corners);
  const auto [end, last] = std::ranges::unique(corners);
  corners.erase(end, last);
  const std::size_t stride = 1 + corners.size() / n_most;
  std::vector<double> heights;
  for (std::size_t k = 0; k + 1 < corners.size(); k += stride)
    for (const double share : {1e-6, 0.5})
      heights.push_back(std::lerp(corners[k], corners[k + 1], share));
  const double mouth = section(height);
  for (const double z : heights)
    if (const double area = section(z); area > (1. + tolerance) * mouth)
    {
      std::ostringstream text;
      text << "mesh narrows towards its mouth, from " << area << " m^2 at " << z
           << " m to " << mouth
           << " m^2: a plate as wide as the particles would not pass";
      refuse(text.str());
    }
}

void Container::set_collar(double its_height)
{
  const std::vector<Edge> rim = rim_of(shell);
  FacetSurface &wall = with_collar = shell;
  std::map<std::int32_t, std::int32_t> upper;
  for (const Edge &edge : rim)
  {
    upper[edge[0]] = static_cast<std::int32_t>(wall.position.size());
    wall.position.push_back(wall.position[static_cast<std::size_t>(edge[0])] +
                            its_height * Vec3::UnitZ());
  }
  // A neighbour runs along their common edge the other way.
  for (const Edge &edge : rim)
  {
    const std::int32_t a = edge[0], b = edge[1];
    wall.triangles.push_back({b, a, upper[a]});
    wall.triangles.push_back({b, upper[a], upper[b]});
  }
  complete(wall);
  add_cover(rim, upper);
}

/// To a point above the collar, so that no triangle of it is flat.
void Container::add_cover(const std::vector<Edge> &rim,
                          const std::map<std::int32_t, std::int32_t> &upper)
{
  FacetSurface closed = with_collar;
  const auto top = static_cast<std::int32_t>(closed.position.size());
  Vec3 peak = 0.5 * (least + most);
  peak.z() = 2. * closed.position.back().z();
  closed.position.push_back(peak);
  for (const Edge &edge : rim)
    closed.triangles.push_back({upper.at(edge[1]), upper.at(edge[0]), top});
  complete(closed);
  inside = {};
  inside.add(closed);
}

bool Container::holds(const Vec3 &centre, double radius) const
{
  return inside.is_clear(centre, radius);
}
} // namespace dem
