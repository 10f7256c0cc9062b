#pragma once

#include <dem/boundary/drum_lifter.h>
#include <dem/boundary/facet_contacts.h>
#include <dem/boundary/facet_motion.h>
#include <dem/boundary/plane.h>
#include <dem/contact/lost_energy.h>
#include <dem/neighbor/contact_point_lists.h>

namespace dem
{
/// Largest number of contact points of a particle and a facet surface, which
/// has several sides.
inline constexpr std::size_t most_wall_contact_points = 24;

/// A drum with the rows of its contacts, which go with them.
struct DrumCandidates
{
  const Drum &drum;
  const DrumLifter &lifter;
  double path_length = 0.; ///< by its lifter [m]
  std::vector<WallRow> &rows;
};

/// A facet surface with the triangles that each particle may reach and the
/// contact points of its contacts, which go with them.
struct FacetCandidateRows
{
  FacetMesh mesh;
  const FacetCandidates &candidates;
  FacetContactPoints &contact_points;
  std::vector<CandidatePair> &particles; ///< on it, sorted
  FacetMotion &watch;                    ///< of these candidates

  /// Of a particle of the candidates.
  std::size_t row_of_particle(std::int32_t particle) const;
};

/// The planes of a scene, which have moved by this much at most.
struct PlaneCandidates
{
  const std::vector<Plane> &planes;
  double path_length = 0.; ///< by the fastest rigid boundary [m]
};

/// Makes the list of the contact points of particles and planes within the
/// skin: what ContactPointLists does for particles. `listed` keeps what is
/// known of each pair.
ContactPointEvents renew_planes(const ContactPointSearchInput &input,
                                const PlaneCandidates &walls,
                                std::vector<CandidatePair> &listed,
                                ContactBatch &batch, LostEnergy &retired);

/// Particles against the parts of a drum; `b` becomes n_drum_parts times the
/// number of the contact plus the part.
ContactPointEvents renew_drum(const ContactPointSearchInput &input,
                              const DrumCandidates &drum,
                              std::vector<CandidatePair> &listed,
                              ContactBatch &batch, LostEnergy &retired);

/// Particles against a facet surface, whose candidates keep the list; `b`
/// becomes the number of the contact.
ContactPointEvents renew_facets(const ContactPointSearchInput &input,
                                const FacetCandidateRows &facets,
                                ContactBatch &batch, LostEnergy &retired);
} // namespace dem
