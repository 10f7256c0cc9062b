#include <dem/measure/region_stress.h>
#include <dem/packing/container.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
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

/// Of edges that are one closed line, along it; seen from above.
Polygon polygon_of(const std::vector<Edge> &rim, const FacetSurface &surface)
{
  std::map<std::int32_t, std::int32_t> next;
  for (const Edge &edge : rim)
    next[edge[0]] = edge[1];
  Polygon polygon;
  for (std::int32_t at = rim.empty() ? 0 : rim[0][0];
       polygon.size() < rim.size(); at = next.at(at))
    polygon.emplace_back(
        surface.position[static_cast<std::size_t>(at)].head<2>());
  return polygon;
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

Container::Container(FacetSurface surface, ContainerBottom its_bottom)
    : bottom(its_bottom)
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
  near_end = tolerance * (most - least).norm();
  if (height <= near_end)
    refuse("mesh is flat");
  open_end(End::top, surface);
  if (bottom == ContainerBottom::open)
    open_end(End::bottom, surface);
  const Rims rims = rims_of(surface);
  lower_rim = polygon_of(rims.bottom, surface);
  add_slopes(surface);
  if (volume_below(height) < 0.) // an open mesh has its normals to the inside
  {
    turn_over(surface);
    std::ranges::reverse(lower_rim);
    for (Slope &slope : slopes)
      slope.area = -slope.area;
  }
  require_wide_mouth();
  shell = std::move(surface);
  set_collar(height);
}

bool Container::is_at(End end, const Vec3 &point) const
{
  return end == End::top ? point.z() > height - near_end : point.z() < near_end;
}

/// Takes a flat lid or floor off, unless there is an opening.
void Container::open_end(End end, FacetSurface &surface) const
{
  const auto is_corner_there = [&](std::int32_t corner)
  { return is_at(end, surface.position[static_cast<std::size_t>(corner)]); };
  if (std::ranges::any_of(open_edges(surface),
                          [&](const Edge &edge) {
                            return std::ranges::any_of(edge, is_corner_there);
                          }))
    return;
  const std::size_t n_removed =
      std::erase_if(surface.triangles, [&](const auto &corners)
                    { return std::ranges::all_of(corners, is_corner_there); });
  if (n_removed == 0)
    refuse(std::string("mesh is closed without a flat ") +
           (end == End::top ? "lid at its top" : "floor at its bottom") +
           ": must be open there or have one, which is taken off");
  drop_unused(surface);
  complete(surface);
}

Container::Rims Container::rims_of(const FacetSurface &surface) const
{
  const bool is_open = bottom == ContainerBottom::open;
  Rims rims;
  double lowest = height, highest = 0.;
  for (const Edge &edge : open_edges(surface))
  {
    const Vec3 &a = surface.position[static_cast<std::size_t>(edge[0])],
               &b = surface.position[static_cast<std::size_t>(edge[1])];
    if (is_at(End::top, a) && is_at(End::top, b))
      rims.top.push_back(edge);
    else if (is_open && is_at(End::bottom, a) && is_at(End::bottom, b))
      rims.bottom.push_back(edge);
    else
    {
      lowest = std::min({lowest, a.z(), b.z()});
      highest = std::max({highest, a.z(), b.z()});
    }
  }
  if (lowest < height && is_open)
    refuse("mesh leaks: it is open from " + metres(lowest) + " to " +
           metres(highest) +
           " above its lowest point: must be open at flat rims at its bottom "
           "and its top alone");
  if (lowest < height)
    refuse("mesh leaks: it is open below its flat rim at " + metres(height) +
           " above its lowest point, down to " + metres(lowest) +
           ": must be open at the rim alone");
  if (const std::size_t n = count_loops(rims.top); n != 1)
    refuse("mesh has " + std::to_string(n) +
           " open rims at its top: must have one, that of the inner surface "
           "of the container");
  if (const std::size_t n = count_loops(rims.bottom); is_open && n != 1)
    refuse("mesh has " + std::to_string(n) +
           " open rims at its bottom: must have one, that of the inner "
           "surface of the container");
  return rims;
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
  slopes.push_back({0., 0., 0., polygon_area(lower_rim)}); // what lies there
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
  const Rims rims = rims_of(shell);
  with_collar = shell;
  FacetSurface closed = shell;
  continue_wall(rims.top, its_height, closed);
  if (!rims.bottom.empty())
    continue_wall(rims.bottom, -height, closed);
  complete(with_collar);
  complete(closed);
  inside = {};
  inside.add(closed);
}

/// Upright, to this height above a rim; `closed` gets a tip above or below it,
/// so that no triangle there is flat.
void Container::continue_wall(const std::vector<Edge> &rim, double by,
                              FacetSurface &closed)
{
  const auto add = [&](FacetSurface &wall)
  {
    std::map<std::int32_t, std::int32_t> end;
    for (const Edge &edge : rim)
    {
      end[edge[0]] = static_cast<std::int32_t>(wall.position.size());
      wall.position.push_back(wall.position[static_cast<std::size_t>(edge[0])] +
                              by * Vec3::UnitZ());
    }
    // A neighbour runs along their common edge the other way.
    for (const auto &[a, b] : rim)
    {
      wall.triangles.push_back({b, a, end[a]});
      wall.triangles.push_back({b, end[a], end[b]});
    }
    return end;
  };
  add(with_collar);
  const auto end = add(closed);
  const auto tip = static_cast<std::int32_t>(closed.position.size());
  Vec3 middle = 0.5 * (least + most);
  middle.z() = closed.position.back().z() + by;
  closed.position.push_back(middle);
  for (const auto &[a, b] : rim)
    closed.triangles.push_back({end.at(b), end.at(a), tip});
}

bool Container::holds(const Vec3 &centre, double radius) const
{
  return (bottom == ContainerBottom::closed || centre.z() >= radius) &&
         inside.is_clear(centre, radius);
}

/// An edge of a triangle runs through the column, or a triangle covers it.
bool Container::holds_column(const Polygon &section) const
{
  const double far = 4. * (most - least).norm();
  const Prism column = without_skin({section, -far, far}, near_end);
  const Eigen::Vector2d axis = polygon_centroid(section);
  for (std::size_t t = 0; t < with_collar.triangles.size(); ++t)
  {
    const auto corner = corners_of(with_collar, static_cast<std::int32_t>(t));
    std::array<double, 3> side; // of the axis beside an edge [m^2]
    for (std::size_t k = 0; k < 3; ++k)
    {
      const Vec3 &from = corner[k], &to = corner[(k + 1) % 3];
      if (part_inside(column, from, to))
        return false;
      const Eigen::Vector2d along = (to - from).head<2>(),
                            across = axis - from.head<2>();
      side[k] = along.x() * across.y() - along.y() * across.x();
    }
    const auto [lowest, highest] = std::ranges::minmax(side);
    const double round_off = near_end * near_end;
    if (lowest > round_off || highest < -round_off)
      return false;
  }
  return holds({axis.x(), axis.y(), 0.5 * height}, 0.);
}
} // namespace dem
