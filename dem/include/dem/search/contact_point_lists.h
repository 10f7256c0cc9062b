#pragma once

#include <dem/boundary/drum_lifter.h>
#include <dem/boundary/plane.h>
#include <dem/contact/forces.h>
#include <dem/contact/wall_contact_point.h>
#include <dem/search/candidate_pair.h>
#include <dem/search/facet_motion.h>
#include <dem/search/particle_maps.h>

namespace dem
{
/// What happened to contacts that follow the true surfaces, since construction.
struct ContactPointEvents
{
  std::int64_t n_scans = 0;  ///< pairs searched for places
  std::int64_t n_late = 0;   ///< found when they overlapped already
  std::int64_t n_jumps = 0;  ///< under load, led to another place in one step
  std::int64_t n_ended = 0;  ///< under load, lost their place: a lens went flat
  std::int64_t n_merged = 0; ///< had come to the place of another one
  std::int64_t n_unlisted = 0; ///< one too many for the pair
  std::int64_t n_lost = 0;     ///< minima of the maps that led to no place

  ContactPointEvents &operator+=(const ContactPointEvents &part);
};

/// Most places that a pair, or a particle on a plane, may touch at.
inline constexpr std::size_t most_contact_points = 8;
/// Likewise on a facet surface, which has several sides.
inline constexpr std::size_t most_wall_places = 24;

/// Whether a contact has come to another place, or lost its own.
bool have_displaced(const ContactBatch &batch);

/// What the lists of places are made from.
struct ContactPointSearchInput
{
  const ForceContext &context;
  const ParticleMaps &maps;
  BatchLayout layout;
  double margin = 0.;    ///< places within it are listed [m]
  double notice = 0.;    ///< travel until the lists are looked at again [m]
  bool is_first = false; ///< overlaps that are there now count in full
};

/// A drum with the rows of its contacts, which go with them.
struct DrumCandidates
{
  const Drum &drum;
  const DrumLifter &lifter;
  double travelled = 0.; ///< by its lifter [m]
  std::vector<WallRow> &rows;
};

/// A facet surface with the triangles that each particle may reach and the
/// contact_points of its contacts, which go with them.
struct FacetCandidateRows
{
  FacetMesh mesh;
  FacetCandidates &candidates;
  std::vector<CandidatePair> &particles; ///< on it, sorted
  FacetMotion &watch;                    ///< of these candidates

  /// Of a particle of the candidates.
  std::size_t row_of_particle(std::int32_t particle) const;
};

/// Keeps the lists of the places where particles meet, or nearly do, by pair.
/// Every pair is searched anew when its own particles have moved as far as the
/// last search is good for, or when a contact of it has lost its place.
/// Contacts keep all they carry and their order; a new one that overlaps
/// already starts with no force.
class ContactPointLists
{
public:
  /// Particle against particle.
  void renew_pairs(const ContactPointSearchInput &input, const Travel &travel,
                   ContactBatch &batch, Dissipation &retired);
  /// Particles against planes that have moved by `walls_travelled` in all [m].
  void renew_planes(const ContactPointSearchInput &input,
                    const std::vector<Plane> &planes, double walls_travelled,
                    ContactBatch &batch, Dissipation &retired);

  /// Particles against the parts of a drum; `b` becomes n_drum_parts times the
  /// number of the contact plus the part.
  void renew_drum(const ContactPointSearchInput &input,
                  const DrumCandidates &drum, ContactBatch &batch,
                  Dissipation &retired);
  /// Particles against a facet surface; `b` becomes the number of the contact.
  void renew_facets(const ContactPointSearchInput &input,
                    const FacetCandidateRows &facets, ContactBatch &batch,
                    Dissipation &retired);

  /// Particles have been added.
  void forget() { reach = -1.; }
  /// The particles have got other numbers.
  void renumber(const std::vector<std::int32_t> &place);
  ContactPointEvents events;

  /// Calls call(value) or call(column) for all that a checkpoint keeps.
  template <class Self, class Value, class Column>
  static void visit(Self &self, const Value &value, const Column &column)
  {
    value(self.events);
    value(self.reach);
    column(self.pairs);
    column(self.supports);
    column(self.on_drum);
  }

private:
  std::vector<CandidatePair> pairs, supports, on_drum; ///< sorted
  double reach = -1.; ///< Travel::centres that `pairs` is good for [m]
};
} // namespace dem
