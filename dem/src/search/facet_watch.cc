#include <dem/search/candidates.h>
#include <dem/search/facet_watch.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace dem
{
namespace
{
std::size_t index(std::int32_t number)
{
  return static_cast<std::size_t>(number);
}

/// Calls call(k, place) for the vertices of a row as the stone sees them [m].
template <class Call>
void for_vertices(const FacetWatch &watch, const Particles &particles,
                  const FacetSurface &surface, std::int32_t stone,
                  std::size_t row, const Call &call)
{
  const Vec3 &centre = particles.position(index(stone));
  const Mat3 to_body = particles.rotation(index(stone)).transpose();
  for (std::int32_t at = watch.row_start[row]; at < watch.row_start[row + 1];
       ++at)
  {
    const std::size_t k = index(at);
    call(k, to_body * (surface.position[index(watch.vertex[k])] - centre));
  }
}
} // namespace

bool FacetWatch::covers(const Particles &particles, const FacetSurface &surface,
                        double margin) const
{
  if (stones.size() != particles.size() ||
      vertices.size() != surface.position.size())
    return false;
  double drift = 0.;
  for (std::size_t v = 0; v < vertices.size(); ++v)
    drift = std::max(drift, (surface.position[v] - vertices[v]).squaredNorm());
  drift = std::sqrt(drift);
  for (std::size_t i = 0; i < stones.size(); ++i)
  {
    const double moved = (particles.position(i) - stones[i].position).norm();
    if (!(particles.body[i].circumscribed_radius + margin + moved + drift <
          stones[i].reach))
      return false;
  }
  return true;
}

void FacetWatch::start(const Particles &particles, const FacetSurface &surface,
                       const FacetCandidates &candidates,
                       const WallSearch &search)
{
  stones.clear();
  for (std::size_t i = 0; i < particles.size(); ++i)
    stones.push_back(
        {particles.position(i), facet_reach(particles, i, search)});
  vertices = surface.position;
  row_start.assign(1, 0);
  vertex.clear();
  for (std::size_t row = 0; row < candidates.stone.size(); ++row)
  {
    const auto first = static_cast<std::ptrdiff_t>(vertex.size());
    for (const std::int32_t t : candidates.triangles_of(row))
      vertex.insert(vertex.end(), surface.triangles[index(t)].begin(),
                    surface.triangles[index(t)].end());
    std::sort(vertex.begin() + first, vertex.end());
    vertex.erase(std::unique(vertex.begin() + first, vertex.end()),
                 vertex.end());
    row_start.push_back(static_cast<std::int32_t>(vertex.size()));
  }
  place.assign(vertex.size(), Vec3::Zero());
  volume.assign(candidates.stone.size(), -1.);
}

void FacetWatch::note(const Particles &particles, const FacetSurface &surface,
                      std::int32_t stone, std::size_t row)
{
  for_vertices(*this, particles, surface, stone, row,
               [this](std::size_t k, const Vec3 &now) { place[k] = now; });
  volume[row] = particles.body[index(stone)].volume;
}

// In the frame of the stone, points of a triangle move no farther than the
// farthest of its corners.
double FacetWatch::moved(const Particles &particles,
                         const FacetSurface &surface, std::int32_t stone,
                         std::size_t row) const
{
  if (volume[row] != particles.body[index(stone)].volume)
    return std::numeric_limits<double>::infinity();
  double square = 0.;
  for_vertices(*this, particles, surface, stone, row,
               [&](std::size_t k, const Vec3 &now)
               { square = std::max(square, (now - place[k]).squaredNorm()); });
  return std::sqrt(square);
}
} // namespace dem
