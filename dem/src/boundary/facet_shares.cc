#include <dem/boundary/facet_surface.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace dem
{
namespace
{
/// Pieces whose directions differ by less have the same nearest point [-].
constexpr double same_direction = 1e-12;

/// A facet, an edge or a vertex that the ball overlaps, by its nearest point.
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

/// Adds the piece with these weights, if the ball overlaps it.
void add_piece(const FacetMesh &mesh, const PressedBall &ball,
               const Piece &proposed, std::vector<Piece> &pieces)
{
  const auto corner = corners_of(mesh.surface, proposed.triangle);
  const auto &w = proposed.weight;
  const Vec3 arm =
      w[0] * corner[0] + w[1] * corner[1] + w[2] * corner[2] - ball.centre;
  const double distance = arm.norm(), overlap = ball.radius - distance;
  if (!(overlap > 0.) || distance == 0.)
    return;
  const Vec3 direction = arm / distance;
  const auto same =
      std::find_if(pieces.begin(), pieces.end(),
                   [&direction](const Piece &known)
                   {
                     return (known.direction - direction).squaredNorm() <
                            same_direction * same_direction;
                   });
  if (same != pieces.end())
    same->count += proposed.count;
  else
    pieces.push_back({proposed.count, proposed.triangle, w, direction, distance,
                      std::pow(overlap, ball.power)});
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

/// What the ball overlaps. Every edge and vertex of it belongs to triangles
/// that it overlaps too and is taken once; what cancels is left out.
void find_pieces(const FacetMesh &mesh, const PressedBall &ball,
                 const std::vector<FacetTouch> &near,
                 std::vector<Piece> &pieces)
{
  const FacetTopology &topology = mesh.topology;
  pieces.clear();
  for (const FacetTouch &touch : near)
  {
    if (touch.distance >= ball.radius)
      continue;
    const std::int32_t own = touch.nearest.triangle;
    const auto t = static_cast<std::size_t>(own);
    add_piece(mesh, ball, {1, own, touch.nearest.weight}, pieces);
    for (std::size_t c = 0; c < 3; ++c)
    {
      if (topology.neighbour[t][c] > own)
        add_piece(mesh, ball,
                  {-1, own, nearest_on_edge(mesh.surface, own, c, ball.centre)},
                  pieces);
      const auto v = static_cast<std::size_t>(mesh.surface.triangles[t][c]);
      const auto first = static_cast<std::size_t>(topology.row_start[v]);
      std::array<double, 3> at_corner{};
      at_corner[c] = 1.;
      if (topology.row_triangle[first] == own)
        add_piece(mesh, ball, {topology.count[v], own, at_corner}, pieces);
    }
  }
  std::erase_if(pieces, [](const Piece &piece) { return piece.count == 0; });
  for (Piece &piece : pieces)
    piece.pressing *= piece.count;
}

/// Of the facets, those that the ball overlaps.
std::size_t n_overlapped(const PressedBall &ball,
                         const std::vector<FacetTouch> &facets)
{
  return static_cast<std::size_t>(
      std::count_if(facets.begin(), facets.end(),
                    [&ball](const FacetTouch &facet)
                    { return facet.distance < ball.radius; }));
}

/// The touch that a piece belongs to: of the first `n` the one whose direction
/// is nearest.
std::size_t patch_of(const Piece &piece, const std::vector<FacetTouch> &touches,
                     std::size_t n)
{
  std::size_t best = 0;
  for (std::size_t t = 1; t < n; ++t)
    if (touches[t].direction.dot(piece.direction) >
        touches[best].direction.dot(piece.direction))
      best = t;
  return best;
}

/// The share of a vertex, a new one if it has none; null: no room.
VertexShare *share_of(FacetShares &shares, std::int32_t vertex)
{
  const auto end = shares.of.begin() + shares.size;
  const auto known = std::find_if(shares.of.begin(), end,
                                  [vertex](const VertexShare &share)
                                  { return share.vertex == vertex; });
  if (known == shares.of.end())
    return nullptr;
  if (known == end)
  {
    ++shares.size;
    known->vertex = vertex;
  }
  return &*known;
}

/// Puts the touch on the pieces of its patch. Forces across the normal go by
/// pressing over distance: then their point lies below the centre along the
/// normal, and stone and surface feel the same moment.
void share(const FacetSurface &surface, const PressedBall &ball,
           const std::vector<Piece> &pieces, std::size_t patch,
           FacetTouch &touch, FacetShares &result)
{
  Vec3 sum = Vec3::Zero();
  double over_distance = 0.;
  FacetShares shares;
  shares.walls = 0;
  for (const Piece &piece : pieces)
  {
    if (piece.patch != patch)
      continue;
    sum += piece.pressing * piece.direction;
    over_distance += piece.pressing / piece.distance;
    shares.walls += piece.count;
  }
  // So deep that edges outweigh facets.
  if (sum.dot(touch.direction) <= 0. || over_distance <= 0. || shares.walls < 1)
    return;
  const double pressing = sum.norm();
  for (const Piece &piece : pieces)
    for (std::size_t c = 0; c < 3; ++c)
    {
      if (piece.patch != patch || piece.weight[c] == 0.)
        continue;
      const auto &corner =
          surface.triangles[static_cast<std::size_t>(piece.triangle)];
      VertexShare *part = share_of(shares, corner[c]);
      if (!part)
        return;
      const double load = piece.weight[c] * piece.pressing;
      part->weight += load / piece.distance / over_distance;
      part->along += load / pressing * piece.direction;
    }
  touch.direction = sum / pressing;
  touch.distance = pressing / over_distance;
  touch.nearest.point = ball.centre + touch.distance * touch.direction;
  shares.extra =
      std::pow(pressing, 1. / ball.power) - (ball.radius - touch.distance);
  result = shares;
}
} // namespace

void share_patches(const FacetMesh &mesh, const PressedBall &ball,
                   const std::vector<FacetTouch> &near,
                   std::vector<FacetTouch> &touches,
                   std::vector<FacetShares> &shares)
{
  shares.assign(touches.size(), {});
  const std::size_t n = n_overlapped(ball, touches);
  if (n == 0 || n_overlapped(ball, near) < 2)
    return;
  // Kept by each thread: a step takes no memory.
  static thread_local std::vector<Piece> pieces;
  find_pieces(mesh, ball, near, pieces);
  for (Piece &piece : pieces)
    piece.patch = patch_of(piece, touches, n);
  for (std::size_t t = 0; t < n; ++t)
    if (std::count_if(pieces.begin(), pieces.end(),
                      [t](const Piece &piece) { return piece.patch == t; }) > 1)
      share(mesh.surface, ball, pieces, t, touches[t], shares[t]);
}
} // namespace dem
