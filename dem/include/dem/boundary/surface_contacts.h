#pragma once

#include <dem/contact/forces.h>
#include <dem/contact/material.h>
#include <dem/search/candidate_pair.h>
#include <dem/search/facet_motion.h>

#include <string>

namespace dem
{
/// A facet surface of the scene and the contacts of the particles on it.
struct SurfaceContacts
{
  /// Throws std::invalid_argument as FacetTopology does.
  SurfaceContacts(std::string its_name, const WallMaterial &law,
                  FacetSurface at_start);

  std::string name;
  WallMaterial material; ///< particles on this surface
  FacetSurface surface;
  FacetTopology topology;
  FacetCandidates candidates;
  ContactBatch batch;
  double work = 0.; ///< done by the surface on the particles [J]
  /// Load on each vertex over time since somebody set it to zero, by the
  /// trapezoidal rule: the momentum that the particles have lost [N s].
  std::vector<Vec3> impulse;
  std::vector<Vec3> load_before; ///< of the last step [N]

  /// Particles that may come to it, if they follow their surfaces; sorted.
  std::vector<CandidatePair> near_particles;
  FacetMotion watch; ///< what has moved since then

  // Space to work in, kept from step to step.
  std::vector<WallRow> rows;
  std::vector<double> overlap; ///< of particles that follow their surfaces [m]
  std::vector<double> extra;   ///< Walls::extra [m]

  FacetMesh mesh() const { return {surface, topology}; }

  /// Where contact k presses; it has touched [m].
  Vec3 point_of(std::size_t k) const;
  /// WallContact::spread of contact k [N m].
  Mat3 spread_of(std::size_t k) const;
  /// Loads on the vertices, what they do in a step of this length [s].
  void book_step(double time_step);
};
} // namespace dem
