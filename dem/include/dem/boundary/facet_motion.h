#pragma once

#include <dem/boundary/facet_contacts.h>

#include <vector>

namespace dem
{
struct WallSearch;

/// How far a facet surface and the particles have moved since the triangles
/// near each particle were gathered (FacetCandidates), and since it was
/// searched for its contact points. Displacements count, not paths: a surface
/// that trembles has moved by its amplitude. All of it is checkpoint data.
struct FacetMotion
{
  /// A particle when triangles were gathered.
  struct Gathered
  {
    Vec3 position = Vec3::Zero(); ///< [m]
    double reach = 0.;            ///< triangles this near to it were taken [m]
  };

  std::vector<Gathered> gathered;
  std::vector<Vec3> vertices; ///< of the surface then [m]

  std::vector<std::int32_t> row_start{0}; ///< size rows of the candidates + 1
  std::vector<std::int32_t> vertex;       ///< of their triangles, each once
  /// In the body frame at the last search [m].
  std::vector<Vec3> vertex_position;
  std::vector<double> volume; ///< of the particle then; < 0: none yet [m^3]

  /// Whether the candidates still hold all that can come within `skin` [m]
  /// of the circumscribed sphere of any particle.
  bool covers(const ParticleSystem &particles, const FacetSurface &surface,
              double skin) const;

  /// The candidates were gathered just now; no particle has been searched.
  void start(const ParticleSystem &particles, const FacetSurface &surface,
             const FacetCandidates &candidates, const WallSearch &search);

  /// The particle of this row is searched now.
  void note(const ParticleSystem &particles, const FacetSurface &surface,
            std::int32_t particle, std::size_t row);

  /// How much nearer any of its triangles may have come to the particle of this
  /// row since its search; infinite if it has not been searched or its shape
  /// has changed [m].
  double moved(const ParticleSystem &particles, const FacetSurface &surface,
               std::int32_t particle, std::size_t row) const;

  /// Some rows of the candidates, in this order, with `gathered` of these
  /// particles. One that was added since has none; covers() is false then.
  FacetMotion select(const std::vector<std::int32_t> &rows,
                     const std::vector<std::int32_t> &particles) const;
  /// Adds rows and particles at the end.
  void append(const FacetMotion &more);

  /// Calls call(column) for all that a checkpoint stores.
  template <class Self, class Column>
  static void visit(Self &self, const Column &column)
  {
    column(self.gathered);
    column(self.vertices);
    column(self.row_start);
    column(self.vertex);
    column(self.vertex_position);
    column(self.volume);
  }
};
} // namespace dem
