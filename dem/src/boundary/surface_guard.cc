#include <dem/boundary/surface_guard.h>
#include <dem/neighbor/cell_grid.h>

#include <numeric>
#include <sstream>

namespace dem
{
namespace
{
std::size_t index(std::int32_t number)
{
  return static_cast<std::size_t>(number);
}

/// Outward, twice the area long [m^2].
Vec3 area_vector(const FacetSurface &surface, std::int32_t triangle)
{
  const auto corner = corners_of(surface, triangle);
  return (corner[1] - corner[0]).cross(corner[2] - corner[0]);
}

Vec3 unit(const Vec3 &vector)
{
  const double length = vector.norm();
  return length > 0. ? Vec3(vector / length) : Vec3(Vec3::Zero());
}

struct Box
{
  Vec3 lower, upper;

  bool meets(const Box &other) const
  {
    return (lower.array() <= other.upper.array()).all() &&
           (other.lower.array() <= upper.array()).all();
  }
};

Box box_of(const std::array<Vec3, 3> &corner)
{
  return {corner[0].cwiseMin(corner[1]).cwiseMin(corner[2]),
          corner[0].cwiseMax(corner[1]).cwiseMax(corner[2])};
}

struct Segment
{
  Vec3 from, to;

  Box box() const { return {from.cwiseMin(to), from.cwiseMax(to)}; }
};

/// Whether the segment goes from one side of the triangle to the other through
/// its inside. In a plane with it: no.
bool passes_through(const Segment &line, const std::array<Vec3, 3> &corner)
{
  const Vec3 normal = (corner[1] - corner[0]).cross(corner[2] - corner[0]);
  const double from = normal.dot(line.from - corner[0]),
               to = normal.dot(line.to - corner[0]);
  if (!(from * to < 0.))
    return false;
  const Vec3 at = line.from + from / (from - to) * (line.to - line.from);
  for (std::size_t c = 0; c < 3; ++c)
    if (normal.dot((corner[(c + 1) % 3] - corner[c]).cross(at - corner[c])) <=
        0.)
      return false;
  return true;
}

bool share_vertex(const FacetSurface &surface, std::int32_t a, std::int32_t b)
{
  for (const std::int32_t v : surface.triangles[index(a)])
    for (const std::int32_t w : surface.triangles[index(b)])
      if (v == w)
        return true;
  return false;
}

/// Centres of the facets in cells, and the largest half width of a facet.
struct FacetCells
{
  std::vector<Box> box;
  Vec3 reach = Vec3::Zero();
  CellGrid cells;

  explicit FacetCells(const FacetSurface &surface)
  {
    const auto n = static_cast<std::int32_t>(surface.triangles.size());
    std::vector<Vec3> centre;
    for (std::int32_t k = 0; k < n; ++k)
    {
      box.push_back(box_of(corners_of(surface, k)));
      centre.push_back(0.5 * (box.back().lower + box.back().upper));
      reach = reach.cwiseMax(0.5 * (box.back().upper - box.back().lower));
    }
    std::vector<std::int32_t> number(index(n));
    std::iota(number.begin(), number.end(), 0);
    cells = CellGrid(centre, number, 2. * reach.maxCoeff());
  }
};

/// Lowest facet that this side of `triangle` passes through; -1: none.
std::int32_t pierced(const FacetSurface &surface, const FacetCells &all,
                     std::int32_t triangle, const Segment &side)
{
  std::int32_t found = -1;
  const Box box = side.box();
  all.cells.visit_box(box.lower - all.reach, box.upper + all.reach,
                      [&](std::int32_t other, const Vec3 &)
                      {
                        if (box.meets(all.box[index(other)]) &&
                            (found < 0 || other < found) &&
                            passes_through(side, corners_of(surface, other)) &&
                            !share_vertex(surface, triangle, other))
                          found = other;
                      });
  return found;
}

/// Sum of the normals round a vertex, weighted by the angles; zero at a rim.
Vec3 normal_at_vertex(const FacetMesh &mesh, std::int32_t vertex)
{
  Vec3 sum = Vec3::Zero();
  for (std::int32_t r = mesh.topology.row_start[index(vertex)];
       r < mesh.topology.row_start[index(vertex) + 1]; ++r)
  {
    const std::int32_t k = mesh.topology.row_triangle[index(r)];
    const auto &numbers = mesh.surface.triangles[index(k)];
    const std::size_t c = numbers[0] == vertex   ? 0
                          : numbers[1] == vertex ? 1
                                                 : 2;
    const auto &neighbour = mesh.topology.neighbour[index(k)];
    if (neighbour[c] < 0 || neighbour[(c + 2) % 3] < 0)
      return Vec3::Zero();
    const auto corner = corners_of(mesh.surface, k);
    const Vec3 one = corner[(c + 1) % 3] - corner[c],
               other = corner[(c + 2) % 3] - corner[c];
    const Vec3 across = one.cross(other);
    sum += std::atan2(across.norm(), one.dot(other)) * unit(across);
  }
  return sum;
}

/// Outward at a nearest point; zero at a rim.
Vec3 normal_at(const FacetMesh &mesh, const NearestPoint &at)
{
  if (at.feature == Feature::vertex)
    return normal_at_vertex(
        mesh, mesh.surface.triangles[index(at.triangle)][index(at.which)]);
  const Vec3 normal = unit(area_vector(mesh.surface, at.triangle));
  if (at.feature == Feature::face)
    return normal;
  const std::int32_t other =
      mesh.topology.neighbour[index(at.triangle)][index(at.which)];
  return other < 0 ? Vec3(Vec3::Zero())
                   : Vec3(normal + unit(area_vector(mesh.surface, other)));
}
} // namespace

std::optional<SurfaceFault> find_fold(const FacetMesh &mesh)
{
  const auto n = static_cast<std::int32_t>(mesh.surface.triangles.size());
  std::vector<Vec3> normal(index(n));
  for (std::int32_t k = 0; k < n; ++k)
    normal[index(k)] = unit(area_vector(mesh.surface, k));
  for (std::int32_t k = 0; k < n; ++k)
    for (std::size_t side = 0; side < 3; ++side)
    {
      const std::int32_t other = mesh.topology.neighbour[index(k)][side];
      if (other <= k || normal[index(k)].dot(normal[index(other)]) > cos_folded)
        continue;
      const auto corner = corners_of(mesh.surface, k);
      return SurfaceFault{SurfaceFlaw::folded, k, other,
                          0.5 * (corner[side] + corner[(side + 1) % 3])};
    }
  return {};
}

std::optional<SurfaceFault> find_crossing(const FacetMesh &mesh)
{
  const FacetSurface &surface = mesh.surface;
  const auto n = static_cast<std::int32_t>(surface.triangles.size());
  const FacetCells all(surface);
  for (std::int32_t k = 0; k < n; ++k)
    for (std::size_t side = 0; side < 3; ++side)
    {
      const std::int32_t neighbour = mesh.topology.neighbour[index(k)][side];
      if (neighbour >= 0 && neighbour < k) // checked from there
        continue;
      const auto corner = corners_of(surface, k);
      const Segment line{corner[side], corner[(side + 1) % 3]};
      const std::int32_t other = pierced(surface, all, k, line);
      if (other >= 0)
        return SurfaceFault{SurfaceFlaw::crossed, k, other,
                            0.5 * (line.from + line.to)};
    }
  return {};
}

std::optional<SurfaceFault> find_left(const FacetBoundary &facets,
                                      const ParticleSystem &particles,
                                      ContactGeometry geometry)
{
  const FacetCandidates &near = facets.near;
  for (std::size_t row = 0; row < near.particle.size(); ++row)
  {
    const std::size_t i = index(near.particle[row]);
    const Vec3 &centre = particles.position(i);
    double nearest = wall_bound(particles, i, geometry);
    NearestPoint at;
    for (const std::int32_t triangle : near.triangles_of(row))
    {
      NearestPoint point =
          nearest_point(centre, corners_of(facets.surface, triangle));
      const double distance = (point.point - centre).norm();
      if (distance >= nearest)
        continue;
      nearest = distance;
      point.triangle = triangle;
      at = point;
    }
    if (at.triangle >= 0 &&
        normal_at(facets.mesh(), at).dot(at.point - centre) < 0.)
      return SurfaceFault{SurfaceFlaw::left, at.triangle,
                          static_cast<std::int32_t>(particles.id[i]), centre};
  }
  return {};
}

std::string describe(const SurfaceFault &fault)
{
  std::ostringstream text;
  switch (fault.flaw)
  {
  case SurfaceFlaw::folded:
    text << "facets " << fault.first << " and " << fault.second
         << " are folded onto each other, or one is inside out,";
    break;
  case SurfaceFlaw::crossed:
    text << "facets " << fault.first << " and " << fault.second
         << " pass through each other";
    break;
  case SurfaceFlaw::left:
    text << "particle " << fault.second << " has left through facet "
         << fault.first;
    break;
  }
  text << " at (" << fault.position.x() << ", " << fault.position.y() << ", "
       << fault.position.z() << ") m";
  return text.str();
}
} // namespace dem
