#pragma once

#include <dem/boundary/drum_contacts.h>
#include <dem/boundary/drum_lifter.h>
#include <dem/boundary/facet_contacts.h>
#include <dem/boundary/wall_refinement.h>

namespace dem
{
/// A drum as particles that follow their surfaces meet it: rows and overlaps by
/// ContactBatch::b. Rows of contacts that touch say where they were before.
struct PlacedDrum
{
  const Drum &drum;
  const DrumLifter &lifter; ///< where the drum stands now
  std::vector<WallRow> &rows;
  std::vector<double> &overlap; ///< < 0: a gap [m]
};

/// The same for a facet surface, with the contact_points of the contacts.
struct PlacedFacets
{
  FacetMesh mesh;
  FacetCandidates &candidates;
  double path_length = 0.; ///< by the fastest vertex at each step [m]
  std::vector<WallRow> &rows;
  std::vector<double> &overlap; ///< < 0: a gap [m]
};

/// Brings every contact of the batch from where it was to its place, and makes
/// its row. A contact that has lost its place stays open until the lists are
/// rebuilt; one that has come to another place takes no more energy than it
/// had; both are counted in what is returned.
ForceSum place_on_drum(const ForceContext &context, const PlacedDrum &walls,
                       ContactBatch &batch);
ForceSum place_on_facets(const ForceContext &context, const PlacedFacets &walls,
                         ContactBatch &batch);

/// Contact k alone: its particle has changed its shape.
void place_again(const ForceContext &context, const PlacedDrum &walls,
                 ContactBatch &batch, std::size_t k);
void place_again(const ForceContext &context, const PlacedFacets &walls,
                 ContactBatch &batch, std::size_t k);
} // namespace dem
