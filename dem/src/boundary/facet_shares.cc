#include <dem/boundary/facet_surface.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace dem
{
namespace
{
/// A weight below this counts as none: the point lies on an edge [-].
constexpr double on_edge = 1e-12;

/// A facet, an edge or a vertex that the sphere overlaps, by its nearest point.
struct Piece
{
  std::int32_t count = 1; ///< facets add, edges that two share are taken off
  std::int32_t triangle = -1;
  std::array<double, 3> weight{}; ///< of the point, barycentric [-]
  Vec3 direction = Vec3::Zero();  ///< unit, from the centre [-]
  double distance = 0.;           ///< [m]
  double pressing = 0.;           ///< overlap to the power; times count later
  std::size_t patch = 0;          ///< the touch that it belongs to
};

/// Where the entry of an edge or a vertex stands; cleared in as many steps as
/// there are entries, and takes no memory once it has grown.
class IndexTable
{
public:
  void grow(std::size_t n)
  {
    if (index.size() < n)
      index.resize(n, none);
  }
  bool has(std::size_t key) const { return index[key] != none; }
  std::size_t at(std::size_t key) const
  {
    return static_cast<std::size_t>(index[key]);
  }
  void set(std::size_t key, std::size_t where)
  {
    index[key] = static_cast<std::int32_t>(where);
    used.push_back(key);
  }
  void clear()
  {
    for (const std::size_t key : used)
      index[key] = none;
    used.clear();
  }

private:
  static constexpr std::int32_t none = -1;
  std::vector<std::int32_t> index;
  std::vector<std::size_t> used;
};

/// Space to work in.
struct Workspace
{
  std::vector<Piece> pieces;
  /// Pieces by edge (three times the lower facet plus its edge) and vertex.
  IndexTable of_edge, of_vertex;
  IndexTable shares; ///< by vertex

  void start(const FacetSurface &surface)
  {
    pieces.clear();
    of_edge.grow(3 * surface.triangles.size());
    of_vertex.grow(surface.position.size());
    shares.grow(surface.position.size());
  }
};

/// Number of an edge of a facet, the same from both sides.
std::size_t edge_number(const FacetMesh &mesh, std::size_t triangle,
                        std::size_t edge)
{
  const std::int32_t other = mesh.topology.neighbour[triangle][edge];
  const auto o = static_cast<std::size_t>(other);
  if (other < 0 || o > triangle)
    return 3 * triangle + edge;
  const std::int32_t end = mesh.surface.triangles[triangle][(edge + 1) % 3];
  std::size_t there = 0; // where the edge of the other facet begins
  while (there < 2 && mesh.surface.triangles[o][there] != end)
    ++there;
  return 3 * o + there;
}

/// The entry of the edge or the vertex that the point lies on; a new one within
/// the facet, or if the table has none.
Piece &piece_at(const FacetMesh &mesh, const Piece &proposed, Workspace &work)
{
  const auto t = static_cast<std::size_t>(proposed.triangle);
  std::size_t n_zero = 0, zero = 0, corner = 0;
  for (std::size_t c = 0; c < 3; ++c)
    if (proposed.weight[c] < on_edge)
    {
      ++n_zero;
      zero = c;
    }
    else
      corner = c;
  const std::size_t fresh = work.pieces.size();
  if (n_zero > 0)
  {
    IndexTable &table = n_zero == 1 ? work.of_edge : work.of_vertex;
    const std::size_t key =
        n_zero == 1
            ? edge_number(mesh, t, (zero + 1) % 3)
            : static_cast<std::size_t>(mesh.surface.triangles[t][corner]);
    if (table.has(key))
      return work.pieces[table.at(key)];
    table.set(key, fresh);
  }
  work.pieces.push_back(proposed);
  work.pieces.back().count = 0;
  return work.pieces.back();
}

/// Adds the piece with these weights, if the sphere overlaps it.
void add_piece(const FacetMesh &mesh, const PressedSphere &sphere,
               Piece proposed, Workspace &work)
{
  const auto corner = corners_of(mesh.surface, proposed.triangle);
  const auto &w = proposed.weight;
  const Vec3 arm =
      w[0] * corner[0] + w[1] * corner[1] + w[2] * corner[2] - sphere.centre;
  proposed.distance = arm.norm();
  const double overlap = sphere.radius - proposed.distance;
  if (!(overlap > 0.) || proposed.distance == 0.)
    return;
  proposed.direction = arm / proposed.distance;
  proposed.pressing = std::pow(overlap, sphere.power);
  piece_at(mesh, proposed, work).count += proposed.count;
}

/// Weights of the point of an edge of the triangle that is nearest to x.
std::array<double, 3> nearest_on_edge(const FacetSurface &surface,
                                      std::int32_t triangle, std::size_t from,
                                      const Vec3 &x)
{
  const auto corner = corners_of(surface, triangle);
  const std::size_t to = (from + 1) % 3;
  const Vec3 side = corner[to] - corner[from];
  const double part =
      std::clamp((x - corner[from]).dot(side) / side.squaredNorm(), 0., 1.);
  std::array<double, 3> weight{};
  weight[from] = 1. - part;
  weight[to] = part;
  return weight;
}

/// What the sphere overlaps. Every edge and vertex of it belongs to triangles
/// that it overlaps too and is taken once; what cancels is left out.
void find_pieces(const FacetMesh &mesh, const PressedSphere &sphere,
                 const std::vector<NearestFacetPoint> &near, Workspace &work)
{
  const FacetTopology &topology = mesh.topology;
  work.start(mesh.surface);
  for (const NearestFacetPoint &touch : near)
  {
    if (touch.distance >= sphere.radius)
      continue;
    const std::int32_t own = touch.nearest.triangle;
    const auto t = static_cast<std::size_t>(own);
    add_piece(mesh, sphere, {1, own, touch.nearest.weight}, work);
    for (std::size_t c = 0; c < 3; ++c)
    {
      if (topology.neighbour[t][c] > own)
        add_piece(
            mesh, sphere,
            {-1, own, nearest_on_edge(mesh.surface, own, c, sphere.centre)},
            work);
      const auto v = static_cast<std::size_t>(mesh.surface.triangles[t][c]);
      const auto first = static_cast<std::size_t>(topology.row_start[v]);
      std::array<double, 3> at_corner{};
      at_corner[c] = 1.;
      if (topology.row_triangle[first] == own)
        add_piece(mesh, sphere, {topology.count[v], own, at_corner}, work);
    }
  }
  work.of_edge.clear();
  work.of_vertex.clear();
  std::erase_if(work.pieces,
                [](const Piece &piece) { return piece.count == 0; });
  for (Piece &piece : work.pieces)
    piece.pressing *= piece.count;
}

/// Of the facets, those that the sphere overlaps.
std::size_t n_overlapped(const PressedSphere &sphere,
                         const std::vector<NearestFacetPoint> &facets)
{
  return static_cast<std::size_t>(
      std::count_if(facets.begin(), facets.end(),
                    [&sphere](const NearestFacetPoint &facet)
                    { return facet.distance < sphere.radius; }));
}

/// The touch that a piece belongs to: of the first `n` the one whose direction
/// is nearest.
std::size_t patch_of(const Piece &piece,
                     const std::vector<NearestFacetPoint> &touches,
                     std::size_t n)
{
  std::size_t best = 0;
  for (std::size_t t = 1; t < n; ++t)
    if (touches[t].direction.dot(piece.direction) >
        touches[best].direction.dot(piece.direction))
      best = t;
  return best;
}

/// The share of a vertex, a new one if it has none.
VertexShare &share_of(std::int32_t vertex, IndexTable &table,
                      FacetShares &shares)
{
  const auto key = static_cast<std::size_t>(vertex);
  if (!table.has(key))
  {
    table.set(key, shares.of.size());
    shares.of.push_back({vertex});
  }
  return shares.of[table.at(key)];
}

/// What the pieces of one patch come to.
struct PatchSum
{
  Vec3 pressing = Vec3::Zero(); ///< V of docs/theory/facets.md
  double over_distance = 0.;    ///< of the pressing
  std::int64_t walls = 0;
};

PatchSum sum_of(const std::vector<Piece> &pieces, std::size_t patch)
{
  PatchSum sum;
  for (const Piece &piece : pieces)
  {
    if (piece.patch != patch)
      continue;
    sum.pressing += piece.pressing * piece.direction;
    sum.over_distance += piece.pressing / piece.distance;
    sum.walls += piece.count;
  }
  return sum;
}

/// Puts the touch on the pieces of its patch. Forces across the normal go by
/// pressing over distance: then their point lies below the centre along the
/// normal, and particle and surface feel the same moment. Where these weights
/// have no sum, forces across the normal stay on the nearest facet.
void share(const FacetSurface &surface, const PressedSphere &sphere,
           Workspace &work, std::size_t patch, NearestFacetPoint &touch,
           FacetShares &result)
{
  const PatchSum sum = sum_of(work.pieces, patch);
  // So deep that edges outweigh facets.
  if (sum.pressing.dot(touch.direction) <= 0.)
    return;
  const double pressing = sum.pressing.norm();
  const bool has_weights = sum.over_distance > 0.;
  for (const Piece &piece : work.pieces)
    for (std::size_t c = 0; c < 3; ++c)
    {
      if (piece.patch != patch || piece.weight[c] == 0.)
        continue;
      const auto &corner =
          surface.triangles[static_cast<std::size_t>(piece.triangle)];
      VertexShare &part = share_of(corner[c], work.shares, result);
      const double load = piece.weight[c] * piece.pressing;
      if (has_weights)
        part.weight += load / piece.distance / sum.over_distance;
      part.along += load / pressing * piece.direction;
    }
  if (!has_weights)
  {
    const auto &corner =
        surface.triangles[static_cast<std::size_t>(touch.nearest.triangle)];
    for (std::size_t c = 0; c < 3; ++c)
      share_of(corner[c], work.shares, result).weight +=
          touch.nearest.weight[c];
  }
  work.shares.clear();
  result.walls = std::max<std::int64_t>(sum.walls, 1);
  touch.direction = sum.pressing / pressing;
  if (has_weights)
  {
    touch.distance = pressing / sum.over_distance;
    touch.nearest.point = sphere.centre + touch.distance * touch.direction;
  }
  result.extra =
      std::pow(pressing, 1. / sphere.power) - (sphere.radius - touch.distance);
}
} // namespace

void share_patches(const FacetMesh &mesh, const PressedSphere &sphere,
                   const std::vector<NearestFacetPoint> &near,
                   std::vector<NearestFacetPoint> &touches,
                   std::vector<FacetShares> &shares)
{
  if (shares.size() < touches.size())
    shares.resize(touches.size());
  for (std::size_t t = 0; t < touches.size(); ++t)
    shares[t].clear();
  const std::size_t n = n_overlapped(sphere, touches);
  if (n == 0 || n_overlapped(sphere, near) < 2)
    return;
  // Kept by each thread: a step takes no memory.
  static thread_local Workspace work;
  find_pieces(mesh, sphere, near, work);
  for (Piece &piece : work.pieces)
    piece.patch = patch_of(piece, touches, n);
  for (std::size_t t = 0; t < n; ++t)
    if (std::count_if(work.pieces.begin(), work.pieces.end(),
                      [t](const Piece &piece) { return piece.patch == t; }) > 1)
      share(mesh.surface, sphere, work, t, touches[t], shares[t]);
}
} // namespace dem
