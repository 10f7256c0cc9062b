#pragma once

#include <dem/boundary/drum_contacts.h>
#include <dem/boundary/drum_lifter.h>
#include <dem/boundary/facet_contacts.h>
#include <dem/boundary/wall_refinement.h>

namespace dem
{
/// A drum as particles that follow their surfaces meet it: rows and overlaps by
/// ContactBatch::b. Rows of touching contacts store their previous positions.
struct FollowedDrum
{
  const Drum &drum;
  const DrumLifter &lifter; ///< where the drum stands now
  std::vector<WallRow> &rows;
  std::vector<double> &overlap; ///< < 0: a gap [m]
};

/// The same for a facet surface, with the contact points of the contacts.
struct FollowedFacets
{
  FacetMesh mesh;
  FacetContactPoints &contact_points;
  double path_length = 0.; ///< by the fastest vertex at each step [m]
  std::vector<WallRow> &rows;
  std::vector<double> &overlap; ///< < 0: a gap [m]
};

/// Finds the contact point of every contact of the batch from the previous one
/// and sets its row. A contact that has lost its contact point stays open until
/// the lists are rebuilt; one that has jumped to another contact point gains no
/// energy; both are counted in the result.
ForceSum relocate_on_drum(const ForceContext &context,
                          const FollowedDrum &walls, ContactBatch &batch);
ForceSum relocate_on_facets(const ForceContext &context,
                            const FollowedFacets &walls, ContactBatch &batch);

/// Contact k alone: its particle has changed its shape.
void relocate_again(const ForceContext &context, const FollowedDrum &walls,
                    ContactBatch &batch, std::size_t k);
void relocate_again(const ForceContext &context, const FollowedFacets &walls,
                    ContactBatch &batch, std::size_t k);
} // namespace dem
