#include "row_table.h"

#include <dem/boundary/facet_motion.h>
#include <dem/boundary/wall_candidates.h>

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

/// Calls call(k, position) for the vertices of a row in the body frame
/// [m].
template <class Call>
void for_vertices(const FacetMotion &watch, const ParticleSystem &particles,
                  const FacetSurface &surface, std::int32_t particle,
                  std::size_t row, const Call &call)
{
  const Vec3 &centre = particles.position(index(particle));
  const Mat3 to_body = particles.rotation(index(particle)).transpose();
  for (std::int32_t at = watch.row_start[row]; at < watch.row_start[row + 1];
       ++at)
  {
    const std::size_t k = index(at);
    call(k, to_body * (surface.position[index(watch.vertex[k])] - centre));
  }
}
} // namespace

bool FacetMotion::covers(const ParticleSystem &particles,
                         const FacetSurface &surface, double skin) const
{
  if (gathered.size() != particles.n_owned() ||
      vertices.size() != surface.position.size())
    return false;
  double drift = 0.;
  for (std::size_t v = 0; v < vertices.size(); ++v)
    drift = std::max(drift, (surface.position[v] - vertices[v]).squaredNorm());
  drift = std::sqrt(drift);
  for (std::size_t i = 0; i < gathered.size(); ++i)
  {
    const double moved = (particles.position(i) - gathered[i].position).norm();
    if (!(particles.shape[i].circumscribed_radius + skin + moved + drift <
          gathered[i].reach))
      return false;
  }
  return true;
}

void FacetMotion::start(const ParticleSystem &particles,
                        const FacetSurface &surface,
                        const FacetCandidates &candidates,
                        const WallSearch &search)
{
  gathered.clear();
  for (std::size_t i = 0; i < particles.n_owned(); ++i)
    gathered.push_back(
        {particles.position(i), facet_reach(particles, i, search)});
  vertices = surface.position;
  row_start.assign(1, 0);
  vertex.clear();
  for (std::size_t row = 0; row < candidates.particle.size(); ++row)
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
  vertex_position.assign(vertex.size(), Vec3::Zero());
  volume.assign(candidates.particle.size(), -1.);
}

void FacetMotion::note(const ParticleSystem &particles,
                       const FacetSurface &surface, std::int32_t particle,
                       std::size_t row)
{
  for_vertices(*this, particles, surface, particle, row,
               [this](std::size_t k, const Vec3 &now)
               { vertex_position[k] = now; });
  volume[row] = particles.shape[index(particle)].volume;
}

FacetMotion
FacetMotion::select(const std::vector<std::int32_t> &rows,
                    const std::vector<std::int32_t> &particles) const
{
  FacetMotion some;
  for (const std::int32_t particle : particles)
    if (index(particle) < gathered.size())
      some.gathered.push_back(gathered[index(particle)]);
  some.vertices = vertices;
  some.row_start = starts_of(row_start, rows);
  some.vertex = entries_of(vertex, row_start, rows);
  some.vertex_position = entries_of(vertex_position, row_start, rows);
  for (const std::int32_t row : rows)
    some.volume.push_back(volume[index(row)]);
  return some;
}

void FacetMotion::append(const FacetMotion &more)
{
  append_entries(more.gathered, gathered);
  append_starts(more.row_start, row_start);
  append_entries(more.vertex, vertex);
  append_entries(more.vertex_position, vertex_position);
  append_entries(more.volume, volume);
}

// In the frame of the particle, points of a triangle move no farther than the
// farthest of its corners.
double FacetMotion::moved(const ParticleSystem &particles,
                          const FacetSurface &surface, std::int32_t particle,
                          std::size_t row) const
{
  if (volume[row] != particles.shape[index(particle)].volume)
    return std::numeric_limits<double>::infinity();
  double square = 0.;
  for_vertices(*this, particles, surface, particle, row,
               [&](std::size_t k, const Vec3 &now) {
                 square =
                     std::max(square, (now - vertex_position[k]).squaredNorm());
               });
  return std::sqrt(square);
}
} // namespace dem
